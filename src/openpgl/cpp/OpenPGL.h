// Open PGL's interface over Wend's learned field, for C++: classes that hold the objects of openpgl.h.
#pragma once

#include <openpgl/cpp/Common.h>
#include <openpgl/cpp/Device.h>
#include <openpgl/cpp/Field.h>
#include <openpgl/cpp/FieldConfig.h>
#include <openpgl/cpp/FieldStatistics.h>
#include <openpgl/cpp/PathSegment.h>
#include <openpgl/cpp/PathSegmentStorage.h>
#include <openpgl/cpp/Region.h>
#include <openpgl/cpp/RussianRoulette.h>
#include <openpgl/cpp/SampleData.h>
#include <openpgl/cpp/SampleStorage.h>
#include <openpgl/cpp/SurfaceSamplingDistribution.h>
#include <openpgl/cpp/VolumeSamplingDistribution.h>

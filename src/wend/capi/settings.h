// Settings and reports of a fit, field by field.
#pragma once

#include <wend/capi/field.h>
#include <wend/guide/fit.h>

namespace wend::capi {

wend_fit_settings from_settings(const guide::FitSettings& settings);
/// Throws a Refusal for numbers that are not finite; fit() itself judges their ranges.
guide::FitSettings to_settings(const wend_fit_settings& settings);
wend_fit_report from_report(const guide::FitReport& report);

}  // namespace wend::capi

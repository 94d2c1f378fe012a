// What a field holds and what the last update did, as text.
#pragma once

#include <openpgl/openpgl.h>

#include <string>

namespace openpgl {
namespace cpp {

struct FieldStatistics {
    /// Takes the handle over.
    explicit FieldStatistics(PGLFieldStatistics fieldStatisticsHandle)
        : m_fieldStatisticsHandle(fieldStatisticsHandle) {}
    FieldStatistics(FieldStatistics&& other) noexcept : m_fieldStatisticsHandle(other.m_fieldStatisticsHandle) {
        other.m_fieldStatisticsHandle = nullptr;
    }
    ~FieldStatistics() { pglReleaseFieldStatistics(m_fieldStatisticsHandle); }

    std::string ToString() const { return Text(pglFieldStatisticsToString(m_fieldStatisticsHandle)); }
    std::string HeaderCSVString() const { return Text(pglFieldStatisticsHeaderCSVString(m_fieldStatisticsHandle)); }
    std::string ToCSVString() const { return Text(pglFieldStatisticsToCSVString(m_fieldStatisticsHandle)); }

private:
    static std::string Text(PGLString text) {
        const std::string copy = text.m_str ? text.m_str : "";
        pglReleaseString(text);
        return copy;
    }

    PGLFieldStatistics m_fieldStatisticsHandle;
};

}  // namespace cpp
}  // namespace openpgl

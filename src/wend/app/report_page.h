// The result of an equal-time comparison as a page to look at.
#pragma once

#include <wend/app/convergence_plot.h>
#include <wend/film/false_colour.h>
#include <wend/stats/spread.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace wend {

/// One way of sampling in the table. Numbers that are not finite show as a dash.
struct ReportRow {
    std::string sampling;
    std::string role;  ///< what it is there to show; may be empty
    double spp = 0;
    double seconds = 0;
    double relmse = 0;
    double relmse_trimmed = 0;
    double error_p9999 = 0;  ///< 99.99th percentile of the errors of pixels
    double mse = 0;
    double flip = 0;
    std::optional<double> ratio;  ///< (relMSE · seconds of classical) / (relMSE · seconds of this)
    Spread relmse_spread = {};    ///< over the renders of this way; of none: not known
    Spread ratio_spread = {};
};

/// A number at each pixel that the page shows in false colours, such as the error.
struct ReportMap {
    std::string name;
    std::string quantity;
    ColourScale scale;
};

/// A picture to look at: the bytes of PNG files.
struct ReportPicture {
    std::string name;
    std::string detail;  ///< below the name; may be empty
    std::string png;
    std::vector<std::string> maps;  ///< one for each of Report::maps, or none
};

/// Everything the page shows. Texts are plain: the page escapes them.
struct Report {
    std::string title;
    std::string scene;
    std::vector<std::pair<std::string, std::string>> settings;  ///< name and value, in the order to show
    std::vector<ReportRow> rows;
    std::vector<ReportMap> maps;
    std::vector<ReportPicture> pictures;  ///< in the order to show
    std::size_t left = 0, right = 1;      ///< the pictures that the slider starts with
    std::vector<ConvergenceSeries> convergence;
};

/// One HTML page that needs no other file and no network: a before-and-after slider between any two pictures or their
/// maps, the pictures in a strip, the table, the convergence plot, and a strip of each map with its colours. Without
/// scripts the slider is absent and the rest is there.
std::string report_page(const Report& report);

}  // namespace wend

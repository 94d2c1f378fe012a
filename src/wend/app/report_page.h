// The result of an equal-time comparison as a page to look at.
#pragma once

#include <wend/app/convergence_plot.h>
#include <wend/film/false_colour.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace wend {

/// One way of sampling in the table. Numbers that are not finite show as a dash.
struct ReportRow {
    std::string sampling;
    double spp = 0;
    double seconds = 0;
    double relmse = 0;
    double relmse_trimmed = 0;
    double mse = 0;
    double flip = 0;
    std::optional<double> ratio;  ///< (relMSE · seconds of classical) / (relMSE · seconds of this)
};

/// A picture to look at: the bytes of PNG files. A reference has no error map.
struct ReportPicture {
    std::string name;
    std::string png;
    std::string error_png;
};

/// Everything the page shows. Texts are plain: the page escapes them.
struct Report {
    std::string title;
    std::string scene;
    std::vector<std::pair<std::string, std::string>> settings;  ///< name and value, in the order to show
    std::vector<ReportRow> rows;
    std::vector<ReportPicture> pictures;  ///< the first two are what the slider starts with
    std::string error_quantity;           ///< what the error maps show, such as "relative squared error"
    ColourScale error_scale;              ///< and in which colours
    std::vector<ConvergenceSeries> convergence;
};

/// One HTML page that needs no other file and no network: the table, a before-and-after slider between any two pictures
/// or their error maps, the convergence plot, and all pictures. Without scripts the slider is absent and the rest is
/// there.
std::string report_page(const Report& report);

}  // namespace wend

#include <wend/app/lobe_page.h>

#include <wend/app/lobe_template.h>
#include <wend/app/markup.h>
#include <wend/app/number_text.h>
#include <wend/app/options.h>
#include <wend/app/page_frame.h>
#include <wend/app/plot.h>
#include <wend/film/tone.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace wend {
namespace {

/// What the script needs, safe within a script element.
std::string data_text(const LobePage& page, const ColourScale& scale) {
    nlohmann::json colours = nlohmann::json::array(), places = nlohmann::json::array();
    for (int i = 0; i < 128; ++i) {
        colours.push_back(hex_colour(static_cast<float>(i) / 127));
    }
    for (const LobePagePlace& one : page.places) {
        nlohmann::json json = place_json(one.place);
        json["marks"] = nlohmann::json::array();
        if (page.flight) {
            json["marks"].push_back({{"name", "camera"}, {"direction", json_vector(-page.flight->ray.direction)}});
        }
        places.push_back(std::move(json));
    }
    const std::string text = json_text(
        {{"low", scale.low}, {"high", scale.high}, {"colours", std::move(colours)}, {"places", std::move(places)}});
    std::string safe;
    for (const char c : text) {
        safe += c == '<' ? "\\u003c" : std::string(1, c);
    }
    return safe;
}

std::string options(const LobePage& page) {
    std::string html;
    for (std::size_t i = 0; i < page.places.size(); ++i) {
        html += fmt::format("<option value=\"{}\">{}</option>\n", i, escape_markup(page.places[i].name));
    }
    return html;
}

std::string lobe_rows(const FieldPlace& place) {
    std::string html;
    int number = 0;
    for (const LobeFacts& lobe : lobe_facts(place)) {
        html += fmt::format(
            "<tr><th scope=\"row\">{} <button type=\"button\" class=\"face\" data-lobe=\"{}\" aria-label=\"Face lobe "
            "{}\">face</button></th><td>{:.1f} %</td><td>{:.3f} {:.3f} {:.3f}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td></tr>\n",
            number + 1, number, number + 1, 100 * lobe.share, lobe.mean.x, lobe.mean.y, lobe.mean.z,
            number_text(static_cast<double>(lobe.concentration)), lobe.distance ? number_text(*lobe.distance) : "far",
            number_text(lobe.records), number_text(lobe.misfit));
        ++number;
    }
    return html;
}

std::string place_section(const LobePagePlace& one, std::size_t number, const ColourScale& scale) {
    const FieldPlace& place = one.place;
    const std::string outside = outside_text(place);
    const std::string map = encode_base64(png_bytes(labelled_picture(one.panels, scale).image));
    return fmt::format(
        "<section data-section=\"{}\">\n<h2>{}</h2>\n{}<dl><div><dt>position</dt><dd>{:.4g} {:.4g} {:.4g}</dd></div>\n"
        "<div><dt>field</dt><dd>{}</dd></div>\n<div><dt>fluence</dt><dd>{}</dd></div>\n"
        "<div><dt>of it found by connections to lights</dt><dd>{}</dd></div>\n"
        "<div><dt>classical share</dt><dd>{:.0f} %</dd></div></dl>\n"
        "<h3>Lobes</h3>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Lobes\"><table>\n"
        "<thead><tr><th scope=\"col\">lobe</th><th scope=\"col\">share</th><th scope=\"col\">towards</th>"
        "<th scope=\"col\">concentration</th><th scope=\"col\">distance</th><th scope=\"col\">records</th>"
        "<th scope=\"col\">misfit</th></tr></thead>\n<tbody>\n{}</tbody></table></div>\n"
        "<p class=\"note\">Distances are in scene units, to where the light of a lobe comes from. <b>Records</b>: how "
        "many of equal weight would know as much of it. <b>Misfit</b>: by how many nats each of them spreads otherwise "
        "than the lobe.</p>\n"
        "<figure class=\"map\"><img alt=\"Radiance by direction, in longitude and latitude, with axes\" "
        "src=\"data:image/png;base64,{}\"></figure>\n</section>\n\n",
        number, escape_markup(one.name),
        outside.empty() ? "" : fmt::format("<p class=\"warning\">{}</p>\n", escape_markup(outside)), place.position.x,
        place.position.y, place.position.z, place.part.name, number_text(static_cast<double>(place.region->fluence())),
        number_text(static_cast<double>(place.connected_fluence)), 100 * place.region->defensive_fraction(),
        lobe_rows(place), map);
}

/// Where flights of both kinds end, as densities over the distance.
std::string flight_plot(const PixelFlight& flight) {
    double all = flight.end_brings;
    for (const FlightPiece& piece : flight.pieces) {
        all += piece.brings;
    }
    PlotSeries classical, guided;
    classical.name = "classical flights";
    guided.name = "guided by the field";
    guided.pen = 1;
    classical.style = guided.style = PlotSeries::Style::line;
    for (const FlightPiece& piece : flight.pieces) {
        const double width = piece.end - piece.begin;
        classical.points.push_back({piece.middle(), piece.collides / width});
        guided.points.push_back({piece.middle(), all > 0 ? piece.brings / all / width : 0});
    }
    PlotPanel panel;
    panel.x.label = "distance from the camera, scene units";
    panel.y.label = "density, 1 / scene unit";
    panel.x.low = 0;
    panel.y.low = 0;
    panel.series = {std::move(classical), std::move(guided)};
    return plot_svg({"Where flights of the pixel scatter in media", {std::move(panel)}, "no medium on the way"});
}

std::string flight_section(const PixelFlight& flight) {
    const std::optional<double> guided = flight.guided_collides();
    return fmt::format(
        "<section>\n<h2>Flight</h2>\n<dl><div><dt>from</dt><dd>{:.4g} {:.4g} {:.4g}</dd></div>\n"
        "<div><dt>towards</dt><dd>{:.4f} {:.4f} {:.4f}</dd></div>\n<div><dt>{}</dt><dd>{}</dd></div>\n"
        "<div><dt>scatters in media on its way</dt><dd>{:.1f} %</dd></div>\n"
        "<div><dt>of the light expected, from there</dt><dd>{}</dd></div></dl>\n{}</section>\n\n",
        flight.ray.origin.x, flight.ray.origin.y, flight.ray.origin.z, flight.ray.direction.x, flight.ray.direction.y,
        flight.ray.direction.z, flight.surface ? "distance to the surface" : "no surface within",
        number_text(flight.length), 100 * (1 - flight.reaches_end),
        guided ? fmt::format("{:.1f} %", 100 * *guided) : "–", flight.pieces.empty() ? "" : flight_plot(flight));
}

}  // namespace

ColourScale scale_of(const LobePage& page) {
    std::vector<DirectionPanel> lobes;
    for (const LobePagePlace& one : page.places) {
        lobes.push_back(one.panels.front());
    }
    return scale_of(lobes);
}

std::string lobe_page(const LobePage& page) {
    const ColourScale scale = scale_of(page);
    std::string places;
    for (std::size_t i = 0; i < page.places.size(); ++i) {
        places += place_section(page.places[i], i, scale);
    }
    const std::string body =
        fill_template(lobe_template, {{"title", escape_markup(page.title)},
                                      {"file", escape_markup(page.file)},
                                      {"options", options(page)},
                                      {"low", number_text(static_cast<double>(scale.low))},
                                      {"high", number_text(static_cast<double>(scale.high))},
                                      {"flight", page.flight ? flight_section(*page.flight) : std::string()},
                                      {"places", places},
                                      {"data", data_text(page, scale)},
                                      {"script", std::string(lobe_script)}});
    return framed_page(page.title, std::string(lobe_style) + bar_style(), body);
}

}  // namespace wend

#include <wend/app/reference_render.h>

#include <wend/io/image_file.h>

#include <fmt/format.h>

#include <utility>

namespace wend {

std::string to_string(const ReferenceEffort& effort) {
    return effort.samples > 0 ? fmt::format("{} spp", effort.samples) : fmt::format("{:g} s", effort.seconds);
}

KnownReference render_reference(const Session& session, const ReferenceEffort& effort,
                                const std::filesystem::path& name,
                                const std::function<void(int half, const RenderProgress& progress)>& watch) {
    // Beyond the seeds of any comparison, which judges by samples of its own.
    constexpr std::uint64_t seeds_apart = 1'000'000;
    const ReferenceFiles files = reference_files(name);
    KnownReference reference;
    int half = 0;
    for (const auto& [image, file] :
         {std::pair(&reference.halves.a, &files.a), std::pair(&reference.halves.b, &files.b)}) {
        RenderSettings settings = session.settings();
        settings.preset = parse_preset("full");
        settings.samples = effort.samples;
        settings.seconds = effort.samples > 0 ? 0 : effort.seconds;
        settings.seed += seeds_apart + static_cast<std::uint64_t>(half);
        Film film = session.new_film(settings);
        watch(half, {});
        Render render(session.scene(), film, settings);
        for (bool goes_on = true; goes_on;) {
            goes_on = render.step(seconds_between_looks);
            watch(half, render.progress());
        }
        const RenderStatistics statistics = render.result();
        ++half;
        *image = film.beauty();
        reference.rendered.push_back({settings.seed, statistics.samples, statistics.seconds});
        if (!name.empty()) {
            write_colours(*file, session.picture(film, settings, statistics));
            reference.files.push_back(file->string());
        }
    }
    return reference;
}

}  // namespace wend

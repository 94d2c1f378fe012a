#include <wend/app/reference.h>
#include <wend/app/reference_render.h>
#include <wend/io/image_file.h>

#include <utility>

namespace wend {

Reference render_reference(const Session& session, double seconds, const std::filesystem::path& name,
                           const std::function<void(int half, const RenderProgress& progress)>& watch) {
    // Beyond the seeds of any comparison, which judges by samples of its own.
    constexpr std::uint64_t seeds_apart = 1'000'000;
    const ReferenceFiles files = reference_files(name);
    Reference reference;
    int half = 0;
    for (const auto& [image, file] : {std::pair(&reference.a, &files.a), std::pair(&reference.b, &files.b)}) {
        RenderSettings settings = session.settings();
        settings.preset = parse_preset("full");
        settings.seconds = reference_effort * seconds;
        settings.seed += seeds_apart + static_cast<std::uint64_t>(half);
        Film film = session.new_film(settings);
        watch(half, {});
        const RenderStatistics statistics =
            render(session.scene(), film, settings, [&](const RenderProgress& progress) {
                watch(half, progress);
                return true;
            });
        ++half;
        *image = film.beauty();
        if (!name.empty()) {
            write_colours(*file, session.picture(film, settings, statistics));
        }
    }
    return reference;
}

}  // namespace wend

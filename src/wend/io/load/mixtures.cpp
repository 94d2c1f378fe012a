#include <wend/io/load/mixtures.h>

#include <fmt/format.h>

#include <functional>

namespace wend {
namespace {

/// What a mixture becomes of which a part is an interface: the other part, as far as it is present.
void leave_out_interfaces(LoadContext& context, TextureLoader& textures, std::vector<LoadedMaterial>& loaded,
                          std::size_t index, const pbrt::MaterialEntity& entity) {
    auto& mix = std::get<MixMaterial>(loaded[index].material);
    const auto part = [&](int i) -> const LoadedMaterial& { return loaded[static_cast<std::size_t>(i)]; };
    const auto is_interface = [&](int i) { return std::holds_alternative<InterfaceMaterial>(part(i).material); };
    const bool first = is_interface(mix.first), second = is_interface(mix.second);
    if (first && second) {
        loaded[index].material = InterfaceMaterial{};
    } else if (mix.is_sum && (first || second)) {
        context.warnings.add(entity.parameters.place_of("materials"),
                             "an \"interface\" in a sum is left out: a \"thindielectric\" of an \"eta\" of 1 lets all "
                             "light pass");
        loaded[index] = LoadedMaterial(part(first ? mix.second : mix.first));
    } else if (first || second) {
        context.warnings.add(entity.parameters.place_of("materials"),
                             "a mixture lets its share of an \"interface\" pass by chance, also of connections to "
                             "lights, which pbrt stops there");
        loaded[index].presence = first ? mix.amount : textures.complement(mix.amount);
        (first ? mix.first : mix.second) = first ? mix.second : mix.first;
    } else if (part(mix.first).presence >= 0 || part(mix.second).presence >= 0) {
        context.warnings.add(entity.parameters.place_of("materials"),
                             "an \"interface\" within a mixture of mixtures is not mixed in: the other material takes "
                             "its place");
    }
}

}  // namespace

void check_mixtures(LoadContext& context, TextureLoader& textures, std::vector<LoadedMaterial>& loaded,
                    const std::vector<pbrt::MaterialEntity>& materials) {
    enum class State : char { unseen, open, done };
    std::vector<State> states(loaded.size(), State::unseen);
    const std::function<void(std::size_t)> visit = [&](std::size_t index) {
        const auto* mix = std::get_if<MixMaterial>(&loaded[index].material);
        if (!mix || states[index] == State::done) {
            return;
        }
        if (states[index] == State::open) {
            throw InputError(materials[index].parameters.place_of("materials"),
                             fmt::format("\"{}\" is made of itself", materials[index].type));
        }
        states[index] = State::open;
        for (const int part : {mix->first, mix->second}) {
            visit(static_cast<std::size_t>(part));
            if (!loaded[index].inside) {
                loaded[index].inside = loaded[static_cast<std::size_t>(part)].inside;
            }
        }
        states[index] = State::done;
        leave_out_interfaces(context, textures, loaded, index, materials[index]);
    };
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        visit(i);
    }
}

}  // namespace wend

#include <wend/guide/join_alike.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace wend::guide {
namespace {

/// How far fluence and flux of cells that are alike may lie from each other, over the mean fluence.
constexpr float tolerance = 0.5f;

/// The light of a subtree's cells, and how far it is to be trusted: means over their volume, and between what values it
/// varies.
struct Light {
    /// Fluences of what was walked to and connected to, and the sum of the fluxes.
    using Values = std::array<float, 5>;

    double volume = 0;
    ArrivingLight walked, connected;
    float confidence = 0;
    Values least{}, most{};
    bool alike = true;

    Light(const ScatteredLight& light, double size)
        : volume(size),
          walked(light.walked),
          connected(light.connected),
          confidence(light.confidence),
          alike(light.near.intensity == 0) {
        const Vec3 flux = walked.fluence * walked.mean + connected.fluence * connected.mean;
        least = most = {walked.fluence, connected.fluence, flux.x, flux.y, flux.z};
    }
    Light(const Light& a, const Light& b) : volume(a.volume + b.volume), alike(a.alike && b.alike) {
        const auto part = static_cast<float>(volume > 0 ? a.volume / volume : 0.5);
        walked = mix(a.walked, b.walked, part);
        connected = mix(a.connected, b.connected, part);
        confidence = part * a.confidence + (1 - part) * b.confidence;
        for (std::size_t i = 0; i < least.size(); ++i) {
            least[i] = std::min(a.least[i], b.least[i]);
            most[i] = std::max(a.most[i], b.most[i]);
            alike = alike && most[i] - least[i] <= tolerance * (walked.fluence + connected.fluence);
        }
    }

private:
    static ArrivingLight mix(const ArrivingLight& a, const ArrivingLight& b, float part) {
        const float from_a = part * a.fluence, from_b = (1 - part) * b.fluence, fluence = from_a + from_b;
        return {fluence, fluence > 0 ? (from_a * a.mean + from_b * b.mean) / fluence : Vec3(0, 0, 0)};
    }
};

}  // namespace

/// Sees a field's inside.
class CellJoining {
public:
    explicit CellJoining(Field& field) : field_(field) {}

    Light join(std::uint32_t index, const Box3& box) {
        Field::Node& node = field_.nodes_[index];
        if (node.axis == Field::Node::leaf) {
            node.alike = 0;
            const Vec3 size = box.max - box.min;
            return {field_.scattered_[node.child],
                    static_cast<double>(size.x) * static_cast<double>(size.y) * static_cast<double>(size.z)};
        }
        const int axis = static_cast<int>(node.axis);
        Box3 below = box, above = box;
        below.max[axis] = above.min[axis] = std::clamp(node.plane, box.min[axis], box.max[axis]);
        const Light first = join(node.child, below), second = join(node.child + 1, above);
        const Light both(first, second);
        node.alike = both.alike ? 1 : 0;
        if (!both.alike) {
            tell(node.child, first);
            tell(node.child + 1, second);
        }
        return both;
    }

    /// The cells below a node, if they are alike.
    void tell(std::uint32_t index, const Light& light) {
        if (light.alike) {
            tell_all(index, light);
        }
    }

private:
    void tell_all(std::uint32_t index, const Light& light) {
        const Field::Node& node = field_.nodes_[index];
        if (node.axis == Field::Node::leaf) {
            ScatteredLight& cell = field_.scattered_[node.child];
            cell.walked = light.walked;
            cell.connected = light.connected;
            cell.confidence = light.confidence;
            return;
        }
        tell_all(node.child, light);
        tell_all(node.child + 1, light);
    }

    Field& field_;
};

Field join_alike(Field field) {
    CellJoining joining(field);
    joining.tell(0, joining.join(0, field.bounds()));
    return field;
}

}  // namespace wend::guide

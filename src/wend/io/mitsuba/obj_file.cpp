#include <wend/io/mitsuba/obj_file.h>

#include <wend/core/error.h>
#include <wend/io/gzip.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>

namespace wend::mitsuba {
namespace {

/// Indices of a corner's position, texture coordinates and normal, from 1; 0: none.
using Corner = std::array<std::uint32_t, 3>;

struct HashOfCorner {
    std::size_t operator()(const Corner& c) const {
        std::uint64_t hash = c[0];
        for (const std::uint64_t next : {c[1], c[2]}) {
            hash = (hash ^ (next + 0x9e3779b97f4a7c15u + (hash << 6) + (hash >> 2))) * 0xff51afd7ed558ccdu;
        }
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

class ObjReader {
public:
    explicit ObjReader(const std::filesystem::path& file) : place_{file.string(), 0, 0} {}

    TriangleMeshData read(std::string_view content) {
        while (!content.empty()) {
            const std::size_t end = std::min(content.find('\n'), content.size());
            ++place_.line;
            read_line(content.substr(0, end));
            content.remove_prefix(std::min(end + 1, content.size()));
        }
        return std::move(mesh_);
    }

private:
    void read_line(std::string_view line) {
        rest_ = line.substr(0, line.find('#'));
        const std::string_view keyword = next_word();
        if (keyword == "v") {
            positions_.push_back(numbers<Vec3, 3>());
            require(is_finite(positions_.back()), "a position is not finite");
        } else if (keyword == "vt") {
            uvs_.push_back(numbers<Vec2, 2>());
        } else if (keyword == "vn") {
            normals_.push_back(numbers<Vec3, 3>());
        } else if (keyword == "f") {
            read_face();
        }
    }

    std::string_view next_word() {
        constexpr std::string_view spaces = " \t\r";
        const std::size_t begin = std::min(rest_.find_first_not_of(spaces), rest_.size());
        const std::size_t end = std::min(rest_.find_first_of(spaces, begin), rest_.size());
        const std::string_view word = rest_.substr(begin, end - begin);
        rest_.remove_prefix(end);
        return word;
    }

    void require(bool is_right, const std::string& message) const {
        if (!is_right) {
            throw InputError(place_, message);
        }
    }

    template <class Vector, int count>
    Vector numbers() {
        Vector vector;
        for (int i = 0; i < count; ++i) {
            std::string_view word = next_word();
            word.remove_prefix(word.starts_with('+') ? 1 : 0);
            float value = 0;
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
            // Too small for a float is 0.
            const bool is_right = error == std::errc() || error == std::errc::result_out_of_range;
            require(is_right && end == word.data() + word.size() && !word.empty(),
                    fmt::format("\"{}\" is no number", word.substr(0, 40)));
            vector[i] = value;
        }
        return vector;
    }

    void read_face() {
        std::uint32_t first = 0, last = 0;
        int corners = 0;
        for (std::string_view word = next_word(); !word.empty(); word = next_word(), ++corners) {
            const std::uint32_t vertex = vertex_of(corner_of(word));
            if (corners >= 2) {
                mesh_.indices.insert(mesh_.indices.end(), {first, last, vertex});
            }
            first = corners == 0 ? vertex : first;
            last = vertex;
        }
        require(corners >= 3, "a face has three corners or more");
    }

    /// "1", "1/2", "1//3" or "1/2/3"; from the end where negative.
    Corner corner_of(std::string_view word) const {
        const std::size_t sizes[] = {positions_.size(), uvs_.size(), normals_.size()};
        Corner corner{};
        std::string_view left = word;
        for (std::size_t i = 0; i < 3 && !left.empty(); ++i) {
            const std::string_view digits = left.substr(0, left.find('/'));
            left.remove_prefix(std::min(digits.size() + 1, left.size()));
            if (digits.empty() && i > 0) {
                continue;
            }
            std::int64_t index = 0;
            const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
            const auto size = static_cast<std::int64_t>(sizes[i]);
            index = index < 0 ? index + size + 1 : index;
            require(error == std::errc() && end == digits.data() + digits.size() && index >= 1 && index <= size,
                    fmt::format("the index {} is out of range: there are {}", digits.substr(0, 40), size));
            corner[i] = static_cast<std::uint32_t>(index);
        }
        require(corner[0] > 0 && std::count(word.begin(), word.end(), '/') <= 2,
                fmt::format("\"{}\" is no corner of a face", word.substr(0, 40)));
        return corner;
    }

    std::uint32_t vertex_of(const Corner& corner) {
        const auto [known, is_new] = vertices_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (!is_new) {
            return known->second;
        }
        require(mesh_.positions.size() < std::numeric_limits<std::int32_t>::max(), "there are too many vertices");
        mesh_.positions.push_back(positions_[corner[0] - 1]);
        if (!uvs_.empty()) {
            mesh_.uvs.resize(mesh_.positions.size() - 1, Vec2(0, 0));
            mesh_.uvs.push_back(corner[1] > 0 ? uvs_[corner[1] - 1] : Vec2(0, 0));
        }
        if (!normals_.empty()) {
            mesh_.normals.resize(mesh_.positions.size() - 1, Vec3(0, 0, 0));
            mesh_.normals.push_back(corner[2] > 0 ? normals_[corner[2] - 1] : Vec3(0, 0, 0));
        }
        return known->second;
    }

    Place place_;
    std::string_view rest_;  ///< of the line
    std::vector<Vec3> positions_, normals_;
    std::vector<Vec2> uvs_;
    std::unordered_map<Corner, std::uint32_t, HashOfCorner> vertices_;
    TriangleMeshData mesh_;
};

}  // namespace

TriangleMeshData read_obj(const std::filesystem::path& file) {
    const std::string content = read_file(file);
    return ObjReader(file).read(content);
}

}  // namespace wend::mitsuba

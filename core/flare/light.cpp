#include "core/flare/light.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/error.h"

namespace ghostlight {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> size_deg(std::string_view text) {
    double value = 0.0;
    text = trimmed(text);
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if (!(value > 0.0 && value <= largest_light_deg)) return std::nullopt;
    return value;
}

[[noreturn]] void refuse(std::string_view text) {
    throw Error({.problem = "not a known size of a light",
                 .file = {},
                 .where = "size",
                 .found = fmt::format("'{}'", text),
                 .expected = fmt::format("point, sun, disc DEG or picture FILE DEG, such as 'disc "
                                         "2.5', up to {} degrees",
                                         largest_light_deg)});
}

}  // namespace

std::string name(const LightSize& size) {
    if (std::holds_alternative<PointSize>(size)) return "point";
    if (const auto* disc = std::get_if<DiscSize>(&size))
        return disc->diameter_deg == sun_diameter_deg ? "sun"
                                                      : fmt::format("disc {}", disc->diameter_deg);
    const auto& picture = std::get<PictureSize>(size);
    return fmt::format("picture {} {}", picture.file, picture.width_deg);
}

LightSize parse_light_size(std::string_view text) {
    const std::string_view whole = trimmed(text);
    if (whole == "point") return PointSize{};
    if (whole == "sun") return DiscSize{};
    if (whole.starts_with("disc")) {
        const auto deg = size_deg(whole.substr(4));
        if (!deg) refuse(text);
        return DiscSize{*deg};
    }
    const auto last_blank = whole.find_last_of(" \t");
    if (whole.starts_with("picture ") && last_blank > 7) {
        const auto deg = size_deg(whole.substr(last_blank));
        const std::string_view file = trimmed(whole.substr(8, last_blank - 8));
        if (!deg || file.empty()) refuse(text);
        return PictureSize{std::string(file), *deg};
    }
    refuse(text);
}

double gain_of_ev(double ev) { return std::exp2(ev); }

}  // namespace ghostlight

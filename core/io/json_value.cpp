#include "core/io/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/error.h"

namespace ghostlight {
namespace {

constexpr std::size_t largest_text = std::size_t{16} << 20;
constexpr std::size_t deepest = 64;
constexpr std::size_t most_fields = 10000;
/// At the end of each object the parser looks through the array that holds it: a few hundred
/// million looks in all.
constexpr std::size_t most_objects = 10000, most_objects_in_all = 100000;
constexpr std::size_t longest_excerpt = 80;

[[noreturn]] void refuse_text(const std::string& file, std::string where, std::string problem,
                              std::string expected) {
    throw Error({.problem = std::move(problem),
                 .file = file,
                 .where = std::move(where),
                 .found = {},
                 .expected = std::move(expected)});
}

std::string cut(std::string text) {
    if (text.size() <= longest_excerpt) return text;
    std::size_t end = longest_excerpt;
    // Not inside a UTF-8 character.
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    text.resize(end);
    return text + "…";
}

/// Watches the parser: nesting, repeated fields, and how many there are.
class Limits {
   public:
    explicit Limits(const std::string& file) : file_(file) {}

    bool operator()(int, Json::parse_event_t event, const Json& parsed) {
        switch (event) {
            case Json::parse_event_t::object_start:
                count_object();
                [[fallthrough]];
            case Json::parse_event_t::array_start:
                levels_.emplace_back();
                if (levels_.size() > deepest)
                    refuse_text(file_, {}, "objects and arrays nest too deeply",
                                fmt::format("at most {} levels", deepest));
                break;
            case Json::parse_event_t::object_end:
            case Json::parse_event_t::array_end:
                levels_.pop_back();
                break;
            case Json::parse_event_t::key:
                if (!levels_.back().fields.insert(parsed.get<std::string>()).second)
                    refuse_text(file_, {}, "an object has the field " + excerpt(parsed) + " twice",
                                "each field once");
                if (levels_.back().fields.size() > most_fields)
                    refuse_text(file_, {}, "an object has too many fields",
                                fmt::format("at most {}", most_fields));
                break;
            case Json::parse_event_t::value:
                break;
        }
        return true;
    }

   private:
    struct Level {
        std::set<std::string> fields;
        std::size_t objects = 0;  ///< right below it
    };

    void count_object() {
        if (!levels_.empty() && ++levels_.back().objects > most_objects)
            refuse_text(file_, {}, "an array has too many objects",
                        fmt::format("at most {}", most_objects));
        if (++objects_ > most_objects_in_all)
            refuse_text(file_, {}, "the file has too many objects",
                        fmt::format("at most {}", most_objects_in_all));
    }

    const std::string& file_;
    std::vector<Level> levels_;
    std::size_t objects_ = 0;
};

/// "[json.exception.parse_error.101] parse error at line 3, column 4: syntax error …" → its parts.
[[noreturn]] void rethrow(const Json::exception& error, const std::string& file) {
    std::string_view text = error.what();
    if (const auto end = text.find("] "); end != text.npos) text.remove_prefix(end + 2);
    std::string where;
    constexpr std::string_view lead = "parse error at ";
    if (text.starts_with(lead)) {
        if (const auto colon = text.find(": "); colon != text.npos) {
            where = text.substr(lead.size(), colon - lead.size());
            text.remove_prefix(colon + 2);
        }
    }
    // The parser quotes what it read last, which may be long or not even be UTF-8.
    const std::string shown =
        Json(std::string(text.substr(0, 300))).dump(-1, ' ', false, Json::error_handler_t::replace);
    refuse_text(file, where, "not valid JSON: " + shown.substr(1, shown.size() - 2), {});
}

void append_compact(std::string& out, const Json& value) {
    if (value.is_object()) {
        out += '{';
        for (bool first = true; const auto& [key, each] : value.items()) {
            if (!std::exchange(first, false)) out += ", ";
            out += Json(key).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
            append_compact(out, each);
        }
        out += '}';
    } else if (value.is_array()) {
        out += '[';
        for (bool first = true; const Json& each : value) {
            if (!std::exchange(first, false)) out += ", ";
            append_compact(out, each);
        }
        out += ']';
    } else if (value.is_number_float()) {
        out += format_number(value.get<double>());
    } else {
        out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
}

std::string escaped(std::string_view name) {
    std::string out;
    for (const char c : name) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

std::string unescaped(std::string_view name) {
    std::string out;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name[i] == '~' && i + 1 < name.size())
            out += name[++i] == '1' ? '/' : '~';
        else
            out += name[i];
    }
    return out;
}

/// The value inside `parent`, or null when there is none.
Json* child(Json& parent, const std::string& name) {
    if (parent.is_object()) {
        const auto found = parent.find(name);
        return found == parent.end() ? nullptr : &*found;
    }
    std::size_t index = 0;
    const auto [end, status] = std::from_chars(name.data(), name.data() + name.size(), index);
    if (!parent.is_array() || status != std::errc{} || end != name.data() + name.size() ||
        index >= parent.size())
        return nullptr;
    return &parent[index];
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file) {
    if (text.size() > largest_text)
        refuse_text(file, {}, fmt::format("the file is too large ({} bytes)", text.size()),
                    "at most 16 MiB");
    if (text.find_first_not_of(" \t\r\n") == text.npos)
        refuse_text(file, {}, "the file is empty", "a lens in JSON");
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
        text.substr(0, 4).find('\0') != text.npos)
        refuse_text(file, {}, "the file is not UTF-8 text", "JSON in UTF-8");
    try {
        return Json::parse(text.begin(), text.end(), Limits(file));
    } catch (const Json::exception& error) {
        rethrow(error, file);
    }
}

std::string compact_json(const Json& value) {
    std::string out;
    append_compact(out, value);
    return out;
}

std::string format_number(double value) {
    if (!std::isfinite(value)) return "null";
    const double size = std::abs(value);
    const bool plain = size == 0.0 || (size >= 1e-4 && size < 1e15);
    char digits[64];
    const auto end =
        std::to_chars(std::begin(digits), std::end(digits), value,
                      plain ? std::chars_format::fixed : std::chars_format::scientific);
    return {digits, end.ptr};
}

std::string excerpt(const Json& value) {
    // A whole lens need not be spelled out to say that it is not a number.
    if (value.is_structured() && value.size() > 20)
        return fmt::format("{} of {} entries", value.is_array() ? "an array" : "an object",
                           value.size());
    return cut(compact_json(value));
}

void JsonAt::refuse(std::string_view problem, std::string_view expected) const {
    throw Error({.problem = std::string(problem),
                 .file = *file_,
                 .where = path_,
                 .found = excerpt(*value_),
                 .expected = std::string(expected)});
}

std::optional<JsonAt> JsonAt::find(std::string_view key) const {
    const auto found = value_->find(key);
    if (found == value_->end() || found->is_null()) return std::nullopt;
    return JsonAt(*found, *file_,
                  path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key));
}

JsonAt JsonAt::at(std::string_view key, std::string_view expected) const {
    const std::string path = path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
    const auto found = value_->find(key);
    if (found == value_->end())
        throw Error({.problem = "missing field",
                     .file = *file_,
                     .where = path,
                     .found = "nothing",
                     .expected = std::string(expected)});
    return JsonAt(*found, *file_, path);
}

JsonAt JsonAt::operator[](std::size_t index) const {
    return JsonAt((*value_)[index], *file_, fmt::format("{}[{}]", path_, index + 1));
}

void JsonAt::require_object(std::string_view expected) const {
    if (!value_->is_object()) refuse("wrong type", expected);
}

void JsonAt::require_array(std::string_view expected) const {
    if (!value_->is_array()) refuse("wrong type", expected);
}

double JsonAt::number(std::string_view expected) const {
    if (!value_->is_number()) refuse("wrong type", expected);
    return value_->get<double>();
}

long JsonAt::integer(long smallest, long largest, std::string_view expected) const {
    const double value = number(expected);
    if (value != std::floor(value) || value < static_cast<double>(smallest) ||
        value > static_cast<double>(largest))
        refuse("not a usable value", expected);
    return static_cast<long>(value);
}

std::string JsonAt::text(std::string_view expected) const {
    if (!value_->is_string()) refuse("wrong type", expected);
    return value_->get<std::string>();
}

bool JsonAt::boolean(std::string_view expected) const {
    if (!value_->is_boolean()) refuse("wrong type", expected);
    return value_->get<bool>();
}

std::optional<double> optional_number(const JsonAt& object, std::string_view key,
                                      std::string_view expected) {
    const auto field = object.find(key);
    if (!field) return std::nullopt;
    return field->number(expected);
}

std::string optional_text(const JsonAt& object, std::string_view key) {
    const auto field = object.find(key);
    return field ? field->text() : std::string();
}

std::size_t keep_unknown(const JsonAt& object, std::initializer_list<std::string_view> known,
                         UnknownFields& unknown, std::string_view below) {
    std::size_t kept = 0;
    for (const auto& [key, value] : object.value().items()) {
        if (std::ranges::find(known, std::string_view(key)) != known.end()) continue;
        std::string name = escaped(key);
        if (!below.empty()) name = fmt::format("{}/{}", below, name);
        unknown[name] = compact_json(value);
        ++kept;
    }
    return kept;
}

void restore_unknown(Json& object, const UnknownFields& unknown) {
    for (const auto& [path, text] : unknown) {
        Json* place = &object;
        std::string_view rest = path;
        for (auto slash = rest.find('/'); place != nullptr && slash != rest.npos;
             slash = rest.find('/')) {
            const std::string name = unescaped(rest.substr(0, slash));
            place = child(*place, name);
            rest.remove_prefix(slash + 1);
            // A layer's medium has a short form, which has no room for further fields.
            if (place != nullptr && name == "layer" && place->is_string() && *place != "ideal")
                *place = Json{{"glass", *place}};
            if (place != nullptr && name == "layer" && place->is_number())
                *place = Json{{"index", *place}};
        }
        if (place != nullptr && place->is_object())
            (*place)[unescaped(rest)] = parse_json(text, "a kept field");
    }
}

}  // namespace ghostlight

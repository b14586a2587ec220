#pragma once

#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/optics/prescription.h"

namespace ghostlight {

/// JSON as it stands in a file: the order of the fields is kept.
using Json = nlohmann::ordered_json;

/// Parses UTF-8 JSON, with or without a byte-order mark. Refuses text that nests deeper than 64
/// levels, objects that give a field twice or have more than 10000, arrays of more than 10000
/// objects, more than 100000 objects, and text above 16 MiB, so that
/// whatever follows may recurse and search plainly. Throws Error naming the line and column.
Json parse_json(std::string_view text, const std::string& file);

/// One line of JSON: `{"a": 1, "b": [2, 3]}`; numbers by format_number.
std::string compact_json(const Json& value);

/// Shortest digits that read back to the same value, in the C locale; no exponent between 1e-4
/// and 1e15. Infinite or NaN becomes null, as JSON has no such numbers.
std::string format_number(double value);

/// Text for a message: as JSON, cut to a readable length, always valid UTF-8.
std::string excerpt(const Json& value);

/// A value of a file and where it is, for reading with errors that name both. Elements of arrays
/// count from 1 in paths. Refers to the JSON, which must outlive it.
class JsonAt {
   public:
    JsonAt(const Json& value, const std::string& file, std::string path = {})
        : value_(&value), file_(&file), path_(std::move(path)) {}

    const Json& value() const { return *value_; }
    const std::string& path() const { return path_; }
    const std::string& file() const { return *file_; }

    /// Throws Error at this place; `found` is the value itself.
    [[noreturn]] void refuse(std::string_view problem, std::string_view expected) const;

    /// True when the object has the field, even as null.
    bool has(std::string_view key) const { return value_->contains(key); }
    /// The field of an object, or nothing when it is absent or null.
    std::optional<JsonAt> find(std::string_view key) const;
    /// The field of an object; Error "missing field" when it is absent.
    JsonAt at(std::string_view key, std::string_view expected) const;
    /// An element of an array, by index from 0.
    JsonAt operator[](std::size_t index) const;
    std::size_t size() const { return value_->size(); }

    void require_object(std::string_view expected = "an object {…}") const;
    void require_array(std::string_view expected = "an array […]") const;
    double number(std::string_view expected = "a number") const;
    /// A number for which `fine` holds.
    template <typename Rule>
    double number(std::string_view expected, Rule fine) const {
        const double value = number(expected);
        if (!fine(value)) refuse("not a usable value", expected);
        return value;
    }
    /// A whole number within [smallest, largest].
    long integer(long smallest, long largest, std::string_view expected) const;
    std::string text(std::string_view expected = "a text") const;
    bool boolean(std::string_view expected = "true or false") const;

   private:
    const Json* value_;
    const std::string* file_;
    std::string path_;
};

/// The number of an optional field; nothing when it is absent or null.
std::optional<double> optional_number(const JsonAt& object, std::string_view key,
                                      std::string_view expected = "a number");
/// The text of an optional field; empty when it is absent or null.
std::string optional_text(const JsonAt& object, std::string_view key);

/// Keeps the object's fields that are not among `known`. `below` says where the object is inside
/// the one that keeps them: "coating/quarter_wave", elements from 0, with "/" and "~" of names
/// written "~1" and "~0" as in JSON pointers. Returns how many were kept.
std::size_t keep_unknown(const JsonAt& object, std::initializer_list<std::string_view> known,
                         UnknownFields& unknown, std::string_view below = {});

/// Puts kept fields back to where they were. One whose place is gone is dropped.
void restore_unknown(Json& object, const UnknownFields& unknown);

}  // namespace ghostlight

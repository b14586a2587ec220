#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace ghostlight {

/// Bad input: what is wrong, and where. Thrown by the core, caught only at the doors (program
/// mains, opening and saving a document, jobs). what() is one line a person can act on.
class Error : public std::runtime_error {
   public:
    struct Parts {
        std::string problem;   ///< what is wrong, in words
        std::string file;      ///< empty when no file is involved
        std::string where;     ///< a line ("line 12") or a field path ("surfaces[3].radius_mm")
        std::string found;     ///< the offending text or value
        std::string expected;  ///< what would have been accepted
    };
    explicit Error(Parts parts);
    explicit Error(const std::string& problem) : Error(Parts{problem, {}, {}, {}, {}}) {}

    const Parts& parts() const { return parts_; }

   private:
    Parts parts_;
};

/// A finding that does not stop the work: what a reader noticed, where, and whether it matters.
struct Note {
    enum class Severity { info, warning };
    Severity severity = Severity::info;
    std::string where;
    std::string text;
    bool operator==(const Note&) const = default;
};
using Notes = std::vector<Note>;

}  // namespace ghostlight

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
    /// `error`: the lens is open, but cannot be traced until this is mended.
    enum class Severity { info, warning, error };
    /// What became of the thing noticed.
    enum class Fate {
        noticed,    ///< taken as it is, but odd
        read,       ///< taken as it is
        converted,  ///< taken, in another unit or form
        assumed,    ///< not in the file: a value was chosen
        left_out    ///< in the file, but not used
    };
    Severity severity = Severity::info;
    std::string where;  ///< "line 12", "SURF 5", "surfaces[3].nd"
    std::string text;
    Fate fate = Fate::noticed;
    bool matters_for_flare = false;  ///< changes where ghosts land, or how bright they are
    std::string proposal = {};       ///< what to do about it; empty when there is nothing to do
    bool operator==(const Note&) const = default;
};
using Notes = std::vector<Note>;

}  // namespace ghostlight

#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/error.h"

namespace ghostlight {

// Lines of an import's report. What matters for flare is a warning.

void note_read(Notes& notes, std::string where, std::string text);
void note_converted(Notes& notes, std::string where, std::string text, bool matters = false,
                    std::string proposal = {});
void note_assumed(Notes& notes, std::string where, std::string text, bool matters = false,
                  std::string proposal = {});
void note_left_out(Notes& notes, std::string where, std::string text, bool matters = false,
                   std::string proposal = {});
/// Taken as it is, but odd.
void note_noticed(Notes& notes, std::string where, std::string text, bool matters = false,
                  std::string proposal = {});
/// The lens opens, but cannot be traced until this is mended.
void note_to_mend(Notes& notes, std::string where, std::string text, std::string proposal);

/// Words of a file that are not used, each reported once with the lines that have it, so that a
/// long file of strange words makes a short report.
class UnusedWords {
   public:
    void add(std::string_view word, const std::string& where);
    void report(Notes& notes) const;

   private:
    struct Use {
        std::string first;  ///< where
        std::size_t count = 0;
    };
    std::map<std::string, Use, std::less<>> words_;
    std::size_t more_ = 0;
};

}  // namespace ghostlight

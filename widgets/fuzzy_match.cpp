#include "widgets/fuzzy_match.h"

#include <QStringList>

#include <algorithm>
#include <limits>
#include <vector>

namespace ghostlight {

namespace {

constexpr int per_letter = 4;
constexpr int at_word_begin = 10;
constexpr int in_a_row = 8;
constexpr int most_gap_cost = 6;
constexpr int none = std::numeric_limits<int>::min() / 2;

bool begins_word(const QString& text, qsizetype at) {
    return at == 0 || (text[at].isLetterOrNumber() && !text[at - 1].isLetterOrNumber());
}

/// The best placing of the word's letters: best[j] is that of those so far with the last on j.
std::optional<int> word_score(const QString& word, const QString& text) {
    const auto size = static_cast<std::size_t>(text.size());
    std::vector<int> best(size, none);
    for (qsizetype i = 0; i < word.size(); ++i) {
        std::vector<int> next(size, none);
        int before = none;  // the best end before j, its gap counted so far
        for (std::size_t j = 0; j < size; ++j) {
            const auto at = static_cast<qsizetype>(j);
            if (text[at] == word[i]) {
                const int here = per_letter + (begins_word(text, at) ? at_word_begin : 0);
                if (i == 0) {
                    next[j] = here - std::min(static_cast<int>(j), most_gap_cost);
                } else {
                    const int row = j > 0 && best[j - 1] > none ? best[j - 1] + in_a_row : none;
                    const int from = std::max(row, before);
                    next[j] = from > none ? from + here : none;
                }
            }
            before = before > none ? before - 1 : none;
            if (best[j] > none) {
                before = std::max(before, best[j] - 1);
            }
        }
        best = std::move(next);
    }
    const int found = best.empty() ? none : *std::ranges::max_element(best);
    return found > none ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<int> fuzzy_score(const QString& pattern, const QString& text) {
    const QString folded = text.toCaseFolded();
    int sum = 0;
    for (const QString& word : pattern.toCaseFolded().split(' ', Qt::SkipEmptyParts)) {
        const auto score = word_score(word, folded);
        if (!score) {
            return std::nullopt;
        }
        sum += *score;
    }
    return sum;
}

}  // namespace ghostlight

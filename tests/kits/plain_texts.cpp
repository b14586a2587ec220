#include "tests/kits/plain_texts.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>
#include <set>

namespace ghostlight::test {

namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':';
}

/// Past the end of what is quoted from `begin` on.
std::size_t past_quote(std::string_view source, std::size_t begin) {
    const char quote = source[begin];
    std::size_t at = begin + 1;
    while (at < source.size() && source[at] != quote) {
        at += source[at] == '\\' ? 2 : 1;
    }
    return std::min(at + 1, source.size());
}

std::size_t past(std::string_view source, std::string_view what, std::size_t from) {
    const std::size_t found = source.find(what, from);
    return found == std::string_view::npos ? source.size() : found + what.size();
}

/// The name before a bracket that opens here, "make<T>(" included.
std::string name_before(std::string_view source, std::size_t bracket) {
    std::size_t end = bracket;
    while (end > 0 && is_space(source[end - 1])) --end;
    if (end > 0 && source[end - 1] == '>') {
        for (int open = 0; end > 0;) {
            --end;
            open += source[end] == '>' ? 1 : source[end] == '<' ? -1 : 0;
            if (open == 0) break;
        }
    }
    std::size_t begin = end;
    while (begin > 0 && is_of_name(source[begin - 1])) --begin;
    return std::string(source.substr(begin, end - begin));
}

/// Whether a translator is shown what stands in this call, by the last part of its name.
bool is_for_translators(std::string_view call) {
    static const std::set<std::string_view, std::less<>> names = {
        "tr", "translate", "QT_TR_NOOP", "QT_TRANSLATE_NOOP", "Q_DECLARE_TR_FUNCTIONS"};
    const std::size_t colon = call.rfind(':');
    return names.contains(colon == std::string_view::npos ? call : call.substr(colon + 1));
}

/// Whether what stands in this call is for the program alone.
bool is_for_no_one(std::string_view call) {
    static const std::set<std::string_view, std::less<>> names = {
        "QKeySequence", "column_header", "Q_ASSERT_X",
        "qPrintable",   "setFamily",     "setObjectName",
        "setProperty",  "setStyleSheet", "QStyleFactory::create",
        "contains",     "compare"};
    return names.contains(call);
}

/// What shows its text to people, however short that is.
bool shows(std::string_view call) {
    static const std::set<std::string_view, std::less<>> names = {
        "setText",        "setToolTip",
        "setStatusTip",   "setAccessibleName",
        "setWindowTitle", "setPlaceholderText",
        "setTitle",       "setPrefix",
        "setSuffix",      "set_text",
        "set_state",      "set_what",
        "QLabel",         "QPushButton",
        "QCheckBox",      "QRadioButton",
        "QGroupBox",      "PanelHeader",
        "EmptyState",     "addAction",
        "addMenu",        "add_menu",
        "addTab",         "addItem",
        "addItems",       "setHeaderLabels",
        "drawText",       "draw_tabular",
        "dim_label",      "quiet_button",
        "framed_field",   "NumberField",
        "ChoiceField",    "setHorizontalHeaderLabels"};
    return names.contains(call);
}

std::string without_marks(const std::string& text) {
    static const std::regex marks(R"(%L?[0-9n]+|<[^>]*>|\\n|&)");
    return std::regex_replace(text, marks, "");
}

/// More than one word, a word that begins as a sentence does, or one with an ellipsis.
bool reads_as_words(const std::string& text) {
    static const std::regex words(R"([A-Za-z]{2}[,.:;]? +\(?[A-Za-z]|^ *[A-Z][a-z]|[A-Za-z]{3}…)");
    return std::regex_search(text, words);
}

/// Keys (Qt translates them), and names that are the same in every language.
bool is_the_same_everywhere(const std::string& text) {
    static const std::regex same(
        R"(((Ctrl|Alt|Shift)\+.*|[a-z_]+\.[a-z0-9_]+|Alt|Esc|Vd|PgF|ΔPgF|MgF2.*|(, )?OpenGL( · )?|Ghostlight|Inter))");
    return std::regex_match(text, same);
}

bool has_a_word(const std::string& text) {
    static const std::regex word("[A-Za-z]{3}");
    return std::regex_search(text, word);
}

}  // namespace

std::vector<SourceText> source_texts(std::string_view source) {
    std::vector<SourceText> found;
    std::vector<std::string> open;  // the names before the brackets that are open here
    std::size_t joined_at = 0;      // where a literal would go on
    int line = 1;
    const auto advance = [&](std::size_t& at, std::size_t to) {
        line +=
            static_cast<int>(std::count(source.begin() + static_cast<std::ptrdiff_t>(at),
                                        source.begin() + static_cast<std::ptrdiff_t>(to), '\n'));
        at = to;
    };
    for (std::size_t at = 0; at < source.size();) {
        const char c = source[at];
        const std::string_view rest = source.substr(at);
        if (rest.starts_with("//") || rest.starts_with("#include")) {
            advance(at, std::min(source.find('\n', at), source.size()));
        } else if (rest.starts_with("/*")) {
            advance(at, past(source, "*/", at));
        } else if (rest.starts_with("R\"")) {
            const std::string end = ")" + std::string(rest.substr(2, rest.find('(') - 2)) + "\"";
            advance(at, past(source, end, at));
        } else if (c == '\'' && at > 0 && is_of_name(source[at - 1])) {
            advance(at, at + 1);  // parts a number's digits
        } else if (c == '\'') {
            advance(at, past_quote(source, at));
        } else if (c == '"') {
            const std::size_t end = past_quote(source, at);
            const std::string text(source.substr(at + 1, end - at - 2));
            const std::string_view between = source.substr(joined_at, at - joined_at);
            if (joined_at > 0 && std::ranges::all_of(between, is_space)) {
                found.back().text += text;
            } else {
                // A list in braces belongs to the call around it.
                const auto call = std::find_if(open.rbegin(), open.rend(),
                                               [](const auto& name) { return !name.empty(); });
                found.push_back({text, call == open.rend() ? std::string() : *call, line});
            }
            advance(at, end);
            joined_at = end;
        } else {
            if (c == '(' || c == '{' || c == '[') {
                open.push_back(c == '(' || c == '{' ? name_before(source, at) : std::string());
            } else if ((c == ')' || c == '}' || c == ']') && !open.empty()) {
                open.pop_back();
            }
            advance(at, at + 1);
        }
    }
    return found;
}

std::vector<SourceText> plain_texts(std::string_view source) {
    std::vector<SourceText> plain = source_texts(source);
    std::erase_if(plain, [](const SourceText& each) {
        const std::string text = without_marks(each.text);
        return is_for_translators(each.call) || is_for_no_one(each.call) ||
               is_the_same_everywhere(each.text) ||
               !(reads_as_words(text) || (shows(each.call) && has_a_word(text)));
    });
    return plain;
}

}  // namespace ghostlight::test

#include "widgets/configuration_edits.h"

#include <QCoreApplication>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/optics/between_configurations.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct ConfigurationEdits {
    Q_DECLARE_TR_FUNCTIONS(ConfigurationEdits)
};

constexpr std::string_view as_listed = "as listed";

auto find(Prescription& lens, std::string_view name) {
    return std::ranges::find(lens.configurations, name, &Configuration::name);
}

bool has(const Prescription& lens, std::string_view name) {
    return std::ranges::find(lens.configurations, name, &Configuration::name) !=
           lens.configurations.end();
}

std::string free_name(const Prescription& lens) {
    for (std::size_t k = lens.configurations.size() + 1;; ++k) {
        std::string name = fmt::format("position {}", k);
        if (!has(lens, name)) {
            return name;
        }
    }
}

}  // namespace

DocumentState with_configuration_added(DocumentState state) {
    Configuration added;
    const auto like = find(state.lens, state.scene.configuration);
    if (like != state.lens.configurations.end()) {
        added = *like;
        added.published = {};  // of another position
    } else {
        for (const Configuration& known : state.lens.configurations) {
            for (const auto& [row, thickness_mm] : known.thickness_mm) {
                added.thickness_mm[row] = state.lens.surfaces.at(row).thickness_mm;
            }
        }
    }
    added.name = free_name(state.lens);
    state.scene.configuration = added.name;
    state.lens.configurations.push_back(std::move(added));
    return state;
}

DocumentState with_configuration_renamed(DocumentState state, std::string_view from,
                                         std::string_view to) {
    const auto known = find(state.lens, from);
    if (known == state.lens.configurations.end()) {
        throw Error(ConfigurationEdits::tr("the lens as listed keeps its name").toStdString());
    }
    if (to.empty()) {
        throw Error(ConfigurationEdits::tr("a configuration needs a name").toStdString());
    }
    if (to != from && (has(state.lens, to) || to == as_listed)) {
        throw Error({ConfigurationEdits::tr("the name is taken").toStdString(),
                     {},
                     {},
                     std::string(to),
                     ConfigurationEdits::tr("another name").toStdString()});
    }
    known->name = to;
    if (state.scene.configuration == from) {
        state.scene.configuration = to;
    }
    return state;
}

DocumentState with_configuration_removed(DocumentState state, std::string_view name) {
    const auto known = find(state.lens, name);
    if (known == state.lens.configurations.end()) {
        throw Error(ConfigurationEdits::tr("choose a configuration: the lens as listed stays")
                        .toStdString());
    }
    if (state.scene.configuration == name) {
        state.scene.configuration =
            known == state.lens.configurations.begin() ? std::string() : std::prev(known)->name;
    }
    state.lens.configurations.erase(known);
    return state;
}

DocumentState with_configuration_between(DocumentState state, std::string_view first,
                                         std::string_view second, double share) {
    Configuration between = between_configurations(state.lens, first, second, share);
    between.name = name_between(first, second);
    state.scene.configuration = between.name;
    const auto former = find(state.lens, between.name);
    if (former == state.lens.configurations.end()) {
        state.lens.configurations.push_back(std::move(between));
    } else {
        *former = std::move(between);
    }
    return state;
}

std::string name_between(std::string_view first, std::string_view second) {
    return fmt::format("between {} and {}", first.empty() ? as_listed : first,
                       second.empty() ? as_listed : second);
}

}  // namespace ghostlight

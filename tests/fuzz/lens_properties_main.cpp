// ghostlight_properties: what must hold for every lens, on thousands of random ones. ./dev
// properties builds and runs it.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "tests/kits/random_lens.h"

int main(int argc, char** argv) {
    using namespace ghostlight;
    std::size_t lenses = 2000, shown = 20;
    std::uint64_t seed = 1;
    CLI::App program("Laws of optics on random lenses");
    program.add_option("--lenses", lenses, "of each kind");
    program.add_option("--seed", seed, "number of the first");
    program.add_option("--shown", shown, "violations printed");
    CLI11_PARSE(program, argc, argv);

    std::size_t printed = 0, refused = 0;
    bool sound = true;
    for (const LensKind kind : {LensKind::plausible, LensKind::hostile}) {
        const char* name = kind == LensKind::plausible ? "plausible" : "hostile";
        std::mutex guard;
        LawCounts counts;
        std::map<std::string, std::size_t> broken;
        parallel_for(lenses, 0, {}, [&](std::size_t k) {
            const std::uint64_t number = seed + k;
            LawCounts own;
            std::vector<Violation> found;
            bool is_refused = false;
            try {
                found = broken_laws(random_lens(kind, number), number, own);
            } catch (const Error&) {
                is_refused = true;
            }
            const std::lock_guard lock(guard);
            counts += own;
            refused += is_refused ? 1 : 0;
            for (const Violation& each : found) {
                ++broken[each.law];
                if (printed++ < shown)
                    fmt::print("{} lens {}: {}: {}\n", name, number, each.law, each.what);
            }
        });
        fmt::print(
            "{} lenses: {}; rays finite: {}, energy: {}, films: {}, reversed: {}, scaled: {}, "
            "turned: {}, mirrored: {}, unfolded: {}\n",
            name, lenses, counts.finite, counts.energy, counts.films, counts.reversed,
            counts.scaled, counts.turned, counts.mirrored, counts.unfolded);
        for (const auto& [law, times] : broken) {
            fmt::print("  BROKEN: {} ({} times)\n", law, times);
            sound = false;
        }
    }
    fmt::print("{} lenses were refused with an error\n", refused);
    return sound ? 0 : 1;
}

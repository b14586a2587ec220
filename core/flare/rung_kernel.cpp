// Compiled once per instruction set; see core/CMakeLists.txt. Nothing here may call an inline
// function that is shared with the rest of the program.
#include "core/flare/rung_kernel.h"

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)

namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA) {
    namespace {

    /// The four channels of a pixel.
    using Color = float __attribute__((vector_size(16)));

    Color load(const float* from) {
        Color value;
        __builtin_memcpy(&value, from, sizeof value);
        return value;
    }
    void store(const Color& value, float* to) { __builtin_memcpy(to, &value, sizeof value); }

    float held(float value, float most) {
        const float low = value > 0.0F ? value : 0.0F;
        return low < most ? low : most;
    }

    /// Loops over pixels, for the compiler to vectorise, go on to a whole vector.
    constexpr std::size_t padding = 16;
    static_assert(rung_chunk % padding == 0);
    std::size_t padded(std::size_t count) { return (count + padding - 1) / padding * padding; }

    /// A rim's places in its table, pixel by pixel.
    struct Places {
        int step[rung_chunk];

        Places(const RungRimView& rim, std::size_t count) {
            for (std::size_t k = 0; k < padded(count); ++k) {
                const auto at = static_cast<float>(static_cast<int>(k));
                step[k] = static_cast<int>(held(rim.place + at * rim.place_step, rim.last));
            }
        }
        Color in(const float* table, std::size_t k) const {
            return load(table + 4 * static_cast<std::ptrdiff_t>(step[k]));
        }
    };

    /// Light, and light times the share of each pixel inside of all rims.
    struct Lights {
        float whole[rung_chunk], covered[rung_chunk];

        explicit Lights(const RungRowView& row) {
            for (std::size_t k = 0; k < padded(row.count); ++k) {
                const auto at = static_cast<float>(static_cast<int>(k));
                whole[k] = covered[k] = row.light + at * row.light_step;
            }
        }
        void cover(const RungRimView& rim, std::size_t count) {
            for (std::size_t k = 0; k < padded(count); ++k) {
                const auto at = static_cast<float>(static_cast<int>(k));
                covered[k] *= held(rim.cover + at * rim.cover_step, 1.0F);
            }
        }
    };

    void add_one(const RungRowView& row) {
        Lights light(row);
        light.cover(row.rims[0], row.count);
        const Places rim(row.rims[0], row.count);
        const float* table = row.rims[0].profile;
        const Color color = load(row.color);
        for (std::size_t k = 0; k < row.count; ++k) {
            float* to = row.pixels + 4 * k;
            const Color change = light.whole[k] * rim.in(table, k) - light.covered[k];
            store(load(to) + change * color, to);
        }
    }

    void add_two(const RungRowView& row) {
        Lights light(row);
        light.cover(row.rims[0], row.count);
        light.cover(row.rims[1], row.count);
        const Places first(row.rims[0], row.count), second(row.rims[1], row.count);
        const float *one = row.rims[0].profile, *two = row.rims[1].profile;
        const Color color = load(row.color);
        for (std::size_t k = 0; k < row.count; ++k) {
            float* to = row.pixels + 4 * k;
            const Color change =
                light.whole[k] * first.in(one, k) * second.in(two, k) - light.covered[k];
            store(load(to) + change * color, to);
        }
    }

    void add_any(const RungRowView& row) {
        const Color color = load(row.color);
        Lights light(row);
        Color inside[rung_chunk];
        for (std::size_t k = 0; k < row.count; ++k)
            inside[k] = light.whole[k] * (row.mask == nullptr ? color : load(row.mask + 4 * k));
        for (std::size_t r = 0; r < row.rim_count; ++r) {
            const RungRimView& rim = row.rims[r];
            light.cover(rim, row.count);
            if (rim.profile != nullptr) {
                const Places places(rim, row.count);
                for (std::size_t k = 0; k < row.count; ++k) inside[k] *= places.in(rim.profile, k);
            } else if (rim.is_sharp) {
                for (std::size_t k = 0; k < row.count; ++k) {
                    const auto at = static_cast<float>(static_cast<int>(k));
                    inside[k] *= held(rim.cover + at * rim.cover_step, 1.0F);
                }
            }
        }
        for (std::size_t k = 0; k < row.count; ++k) {
            float* to = row.pixels + 4 * k;
            store(load(to) + (inside[k] - light.covered[k] * color), to);
        }
    }

    }  // namespace

    void add_fringes(const RungRowView& row) {
        const auto is_fringed = [&](std::size_t r) { return row.rims[r].profile != nullptr; };
        if (row.mask == nullptr && row.rim_count == 1 && is_fringed(0))
            add_one(row);
        else if (row.mask == nullptr && row.rim_count == 2 && is_fringed(0) && is_fringed(1))
            add_two(row);
        else
            add_any(row);
    }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_,GHOSTLIGHT_ISA)

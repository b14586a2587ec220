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

    /// A rim's places in its table and its shares, pixel by pixel; for the compiler to vectorise.
    struct Along {
        int step[rung_chunk];
        float part[rung_chunk], cover[rung_chunk];

        Along(const RungRimView& rim, std::size_t count) {
            for (std::size_t k = 0; k < count; ++k) {
                const auto at = static_cast<float>(static_cast<int>(k));
                const float place = held(rim.place + at * rim.place_step, rim.last);
                step[k] = static_cast<int>(place);
                part[k] = place - static_cast<float>(step[k]);
                cover[k] = held(rim.cover + at * rim.cover_step, 1.0F);
            }
        }
        Color profile(const float* table, std::size_t k) const {
            const float* from = table + 4 * static_cast<std::size_t>(step[k]);
            const Color low = load(from), high = load(from + 4);
            return low + part[k] * (high - low);
        }
    };

    void add_one(const RungRowView& row) {
        const Along rim(row.rims[0], row.count);
        const float* table = row.rims[0].profile;
        const Color color = load(row.color);
        for (std::size_t k = 0; k < row.count; ++k) {
            const float light =
                row.light + static_cast<float>(static_cast<int>(k)) * row.light_step;
            float* to = row.pixels + 4 * k;
            store(load(to) + (rim.profile(table, k) - rim.cover[k]) * (light * color), to);
        }
    }

    void add_two(const RungRowView& row) {
        const Along first(row.rims[0], row.count), second(row.rims[1], row.count);
        const float *one = row.rims[0].profile, *two = row.rims[1].profile;
        const Color color = load(row.color);
        for (std::size_t k = 0; k < row.count; ++k) {
            const float light =
                row.light + static_cast<float>(static_cast<int>(k)) * row.light_step;
            float* to = row.pixels + 4 * k;
            const Color change =
                first.profile(one, k) * second.profile(two, k) - first.cover[k] * second.cover[k];
            store(load(to) + change * (light * color), to);
        }
    }

    void add_any(const RungRowView& row) {
        const Color color = load(row.color);
        Color inside[rung_chunk];
        float covered[rung_chunk];
        for (std::size_t k = 0; k < row.count; ++k) {
            inside[k] = row.mask == nullptr ? color : load(row.mask + 4 * k);
            covered[k] = 1.0F;
        }
        for (std::size_t r = 0; r < row.rim_count; ++r) {
            const RungRimView& rim = row.rims[r];
            const Along along(rim, row.count);
            for (std::size_t k = 0; k < row.count; ++k) covered[k] *= along.cover[k];
            if (rim.profile != nullptr)
                for (std::size_t k = 0; k < row.count; ++k)
                    inside[k] *= along.profile(rim.profile, k);
            else if (rim.is_sharp)
                for (std::size_t k = 0; k < row.count; ++k) inside[k] *= along.cover[k];
        }
        for (std::size_t k = 0; k < row.count; ++k) {
            const float light =
                row.light + static_cast<float>(static_cast<int>(k)) * row.light_step;
            float* to = row.pixels + 4 * k;
            store(load(to) + light * (inside[k] - covered[k] * color), to);
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

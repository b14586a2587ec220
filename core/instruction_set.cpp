#include "core/instruction_set.h"

#include <cstdlib>
#include <string_view>

namespace ghostlight {
namespace {

#ifdef GHOSTLIGHT_HAVE_X86_ISA
bool runs(InstructionSet set) {
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("f16c");
    if (set == InstructionSet::v3) return v3;
    return v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}

InstructionSet choose() {
    const char* variable = std::getenv("GHOSTLIGHT_INSTRUCTION_SET");
    const std::string_view asked = variable == nullptr ? "" : variable;
    if (asked == "v2") return InstructionSet::v2;
    if (asked == "v4" && runs(InstructionSet::v4)) return InstructionSet::v4;
    return runs(InstructionSet::v3) ? InstructionSet::v3 : InstructionSet::v2;
}
#endif

}  // namespace

InstructionSet instruction_set() {
#ifdef GHOSTLIGHT_HAVE_X86_ISA
    static const InstructionSet chosen = choose();
    return chosen;
#else
    return InstructionSet::portable;
#endif
}

const char* instruction_set_name() {
    switch (instruction_set()) {
        case InstructionSet::portable:
            return "portable";
        case InstructionSet::v2:
            return "SSE4.2";
        case InstructionSet::v3:
            return "AVX2";
        case InstructionSet::v4:
            return "AVX-512";
    }
    return "";
}

}  // namespace ghostlight

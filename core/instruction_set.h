#pragma once

namespace ghostlight {

/// The variants that kernels are compiled for: x86-64-v2 (SSE4.2), v3 (AVX2, FMA), v4 (AVX-512).
enum class InstructionSet { portable, v2, v3, v4 };

/// The one in use: the widest of v2 and v3 that this machine runs, or what the environment's
/// GHOSTLIGHT_INSTRUCTION_SET ("v2", "v3", "v4") asks for, if the machine runs that. Asked once.
/// v4 is used on request only: nobody has measured it on many machines.
InstructionSet instruction_set();

/// "SSE4.2", "AVX2", "AVX-512" or "portable", for status lines and reports.
const char* instruction_set_name();

}  // namespace ghostlight

/// Calls the variant of a kernel for this machine.
#ifdef GHOSTLIGHT_HAVE_X86_ISA
#define GHOSTLIGHT_DISPATCH(kernel, ...)                                   \
    (::ghostlight::instruction_set() == ::ghostlight::InstructionSet::v4   \
         ? kernels_v4::kernel(__VA_ARGS__)                                 \
     : ::ghostlight::instruction_set() == ::ghostlight::InstructionSet::v3 \
         ? kernels_v3::kernel(__VA_ARGS__)                                 \
         : kernels_v2::kernel(__VA_ARGS__))
/// Declares something in the namespace of every variant.
#define GHOSTLIGHT_EVERY_SET(declare) declare(kernels_v2) declare(kernels_v3) declare(kernels_v4)
#else
#define GHOSTLIGHT_DISPATCH(kernel, ...) kernels_generic::kernel(__VA_ARGS__)
#define GHOSTLIGHT_EVERY_SET(declare) declare(kernels_generic)
#endif

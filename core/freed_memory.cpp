#include "core/freed_memory.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace ghostlight {

void keep_freed_memory() {
#ifdef __GLIBC__
    constexpr int largest_reused = 32 << 20;  // bytes; glibc takes no more (mallopt(3))
    constexpr int kept = 256 << 20;           // bytes at the heap's end
    mallopt(M_MMAP_THRESHOLD, largest_reused);
    mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

}  // namespace ghostlight

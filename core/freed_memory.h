#pragma once

namespace ghostlight {

/// For programs, at their start: memory that a picture has freed stays with the process for the
/// next one, up to some hundred MB. By default glibc returns blocks from 128 KB on at once, and
/// every picture pays for having its pages mapped and cleared again: a third of the reference's
/// time (docs/benchmarks.md). Elsewhere than with glibc this does nothing.
void keep_freed_memory();

}  // namespace ghostlight

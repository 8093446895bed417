// The command line's allocator is jemalloc, which asks the kernel for huge pages (2 MiB) where the
// C library asks for 4 KiB: a render fills hundreds of MiB once, and a third of its time went into
// the faults of small pages. Programs under a sanitizer have the sanitizer's allocator instead.
#pragma once

namespace patina::cli {

// For what computes long on memory that it fills once: huge pages gain nothing there, and a tenth
// more memory is held. From here on.
void useSmallPages();

} // namespace patina::cli

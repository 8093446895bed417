// The editor's allocator is jemalloc. Its hours are full of what is made and freed in small blocks
// among others that stay (shader compilers most of all: some 4 MiB a program on a software driver);
// in the C library's heaps that leaves holes which never return to the system. Programs under a
// sanitizer have the sanitizer's allocator instead.
#pragma once

namespace patina::editor {

// How long freed memory is kept for reuse.
inline constexpr int kFreedMemoryMs = 1000;

// To be called first thing in main(), before there are threads: freed memory goes back to the
// system after kFreedMemoryMs, by a thread of the allocator's. A warning in the log where the
// allocator refuses.
void prepareAllocator();

} // namespace patina::editor

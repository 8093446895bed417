// Keeps a program that runs for hours from holding memory that it freed long ago.
#pragma once

namespace patina {

// To be called first thing in main(), before there are threads. By itself, glibc raises the size
// from which a block is mapped, and so returned when it is freed, to that of the largest block
// freed so far (up to 32 MiB), and gives each thread a heap of its own, up to eight per core:
// images, meshes and textures then leave holes in many heaps, which the process keeps. Nothing
// happens with another C library.
void boundHeapGrowth();

// Returns to the system what is free inside of the heaps. Takes milliseconds: for moments when much
// was freed and nobody waits, as after another scene was opened.
void returnFreedMemory();

} // namespace patina

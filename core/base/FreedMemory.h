// Keeps a program that runs for long from holding memory that it has freed.
#pragma once

namespace patina {

// Returns to the system what is free inside of the C library's heaps. Takes milliseconds: for
// moments when much was freed and nobody waits, as when a scene's rays are no longer needed. With
// another C library or another allocator nothing happens.
void returnFreedMemory();

} // namespace patina

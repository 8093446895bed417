// The moments in which a file that is written gets its final name. A process that ends in between,
// whatever its other threads do, would leave it behind under a temporary one.
#pragma once

#include <chrono>

namespace patina {

// Held in between; any number at a time.
class FileNaming {
  public:
    FileNaming();
    ~FileNaming();
    FileNaming(const FileNaming&) = delete;
    FileNaming& operator=(const FileNaming&) = delete;
};

// For whoever ends the process from a thread: waits until nobody is in between, and lets nobody
// begin any more. False after `patience`.
bool stopFileNaming(std::chrono::milliseconds patience);

} // namespace patina

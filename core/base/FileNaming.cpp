#include "core/base/FileNaming.h"

#include <shared_mutex>

namespace patina {
namespace {

// As long as the process: threads that it does not wait for may still write.
std::shared_timed_mutex& naming() {
    static auto* mutex = new std::shared_timed_mutex;
    return *mutex;
}

} // namespace

FileNaming::FileNaming() {
    naming().lock_shared();
}

FileNaming::~FileNaming() {
    naming().unlock_shared();
}

bool stopFileNaming(std::chrono::milliseconds patience) {
    return naming().try_lock_for(patience);
}

} // namespace patina

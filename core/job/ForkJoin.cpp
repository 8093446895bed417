#include "core/job/ForkJoin.h"

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace patina {

namespace {

#if defined(__SANITIZE_THREAD__)
void acquire(char& point) {
    __tsan_acquire(&point);
}
void release(char& point) {
    __tsan_release(&point);
}
#else
void acquire(char&) {}
void release(char&) {}
#endif

} // namespace

void ForkJoin::fork() {
    release(m_forked);
}

void ForkJoin::join() {
    acquire(m_joined);
}

ForkJoin::Branch::Branch(ForkJoin& owner)
    : m_owner(owner) {
    acquire(m_owner.m_forked);
}

ForkJoin::Branch::~Branch() {
    release(m_owner.m_joined);
}

} // namespace patina

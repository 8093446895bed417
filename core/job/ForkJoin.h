// Tells ThreadSanitizer what oneTBB and Embree guarantee but, not being compiled with it, cannot
// show: their branches begin after the fork and end before the join. Branches stay unordered among
// themselves, so that races between them are found. Does nothing in other builds.
#pragma once

namespace patina {

class ForkJoin {
  public:
    ForkJoin() { fork(); }
    ~ForkJoin() { join(); }
    ForkJoin(const ForkJoin&) = delete;
    ForkJoin& operator=(const ForkJoin&) = delete;

    void fork(); // by the thread that hands work over, with all that it wrote so far
    void join(); // by the same thread, when the work is done; so does the end of life

    // Lives while a thread of the library runs our code.
    class Branch {
      public:
        explicit Branch(ForkJoin& owner);
        ~Branch();
        Branch(const Branch&) = delete;
        Branch& operator=(const Branch&) = delete;

      private:
        ForkJoin& m_owner;
    };

  private:
    char m_forked = 0; // only their addresses matter
    char m_joined = 0;
};

} // namespace patina

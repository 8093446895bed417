// LDR-FLIP of many pictures against one reference, whose half of the work is done once.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"

#include <memory>
#include <span>

namespace patina {

class FlipAgainst {
  public:
    // Light that a display shows, linear: it is cut to 0…1. Errors as those of computeFlip().
    static Result<FlipAgainst> create(const Image& reference);
    FlipAgainst(FlipAgainst&&) noexcept;
    FlipAgainst& operator=(FlipAgainst&&) noexcept;
    ~FlipAgainst();

    // One thread's buffers.
    class Worker {
      public:
        explicit Worker(const FlipAgainst& reference); // which must outlive it
        Worker(Worker&&) noexcept;
        Worker& operator=(Worker&&) noexcept;
        ~Worker();
        // Errors of all pixels, the numbers that computeFlip() has for the same light. `image`: as
        // the reference, of its size and finite. errors: one per pixel.
        void compare(const Image& image, std::span<float> errors);

      private:
        struct Impl;
        std::unique_ptr<Impl> m_impl;
    };

  private:
    struct Impl;
    explicit FlipAgainst(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina

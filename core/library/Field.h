// A square of numbers that repeats without a seam: what the procedural materials are composed of.
#pragma once

#include "core/job/Parallel.h"

#include <cstddef>
#include <vector>

namespace patina::library {

class Field {
  public:
    explicit Field(int size, float value = 0.0f) // size: a power of two
        : m_size(size)
        , m_values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), value) {}

    [[nodiscard]] int size() const { return m_size; }
    [[nodiscard]] float* row(int y) { return m_values.data() + offset(y); }
    [[nodiscard]] const float* row(int y) const { return m_values.data() + offset(y); }
    // Coordinates wrap around.
    [[nodiscard]] float& at(int x, int y) { return row(y & (m_size - 1))[x & (m_size - 1)]; }
    [[nodiscard]] float at(int x, int y) const { return row(y & (m_size - 1))[x & (m_size - 1)]; }
    // Bilinear between pixel centres, in pixels; wraps around.
    [[nodiscard]] float sample(float x, float y) const;

  private:
    [[nodiscard]] std::size_t offset(int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(m_size);
    }
    int m_size;
    std::vector<float> m_values;
};

// Calls body(y) for every row, on all cores; for no more once the job is cancelled.
template <class Body>
void forRows(const JobContext& job, int rows, const Body& body) {
    parallelFor(job, static_cast<std::size_t>(rows), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            body(static_cast<int>(y));
    });
}
template <class Body>
void forRows(int rows, const Body& body) {
    forRows(JobContext(), rows, body);
}

// A field whose pixels are body(x, y).
template <class Body>
Field makeField(int size, const Body& body) {
    Field result(size);
    forRows(size, [&](int y) {
        float* out = result.row(y);
        for (int x = 0; x < size; ++x)
            out[x] = body(x, y);
    });
    return result;
}

// `source` read at (x + amount * dx, y + amount * dy), amount in pixels.
Field warp(const Field& source, const Field& dx, const Field& dy, float amount);

// Two passes of a box (2 radius + 1)² wide: close to a Gaussian of sigma 0.8 radius.
Field blur(const Field& source, int radius);

} // namespace patina::library

// Area-weighted reduction of rows of samples: what each target pixel covers of the source counts by
// its share.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace patina {

// The share of each source pixel in one target pixel along an axis.
struct Footprint {
    int first = 0;
    std::vector<float> weights; // sum to 1
};
[[nodiscard]] std::vector<Footprint> footprints(int from, int to); // to <= from

struct ImageSize {
    int width = 0, height = 0;
    friend bool operator==(const ImageSize&, const ImageSize&) = default;
};
// The largest size with the same proportions whose sides are at most `maxSide`; only nearly the
// same where the sides have no common divisor. Unchanged when it fits, or when maxSide is 0.
[[nodiscard]] ImageSize reducedSize(ImageSize size, int maxSide);

// Takes an image row by row, from the top, and makes a smaller one: the whole large image never
// needs to exist.
class RowReducer {
  public:
    // Both target sides at most as long as the source's.
    RowReducer(int fromWidth, int fromHeight, int toWidth, int toHeight, int channels);

    // fromWidth · channels samples.
    void addRow(std::span<const float> row);
    // toWidth · toHeight · channels samples, complete after fromHeight rows.
    [[nodiscard]] std::span<const float> result() const { return m_result; }

  private:
    int m_channels;
    std::vector<Footprint> m_columns, m_rows;
    std::vector<float> m_reduced; // the current row, reduced along x
    std::vector<float> m_result;
    int m_sourceRow = 0;
    std::size_t m_firstRow = 0; // the first target row that still takes from what comes
};

} // namespace patina

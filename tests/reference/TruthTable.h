// The numbers of docs/maths/transfer-truth.md: what is known in closed form beside what Patina
// finds.
#pragma once

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace patina::reference {

class TruthTable {
  public:
    // Fails the test where `found` is farther from `truth` than `tolerance`.
    void add(const std::string& what, double truth, double found, double tolerance);

    // Fails where the rows are not in the file: with the same truth and tolerance, and what was
    // found to within a fifth of the tolerance. Prints what should be there.
    void expectIn(const std::string& file) const;

  private:
    struct Row {
        std::string what;
        double truth, found, tolerance;
    };
    [[nodiscard]] static std::string text(const Row& row);
    std::vector<Row> m_rows;
};

} // namespace patina::reference

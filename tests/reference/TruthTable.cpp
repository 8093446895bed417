#include "tests/reference/TruthTable.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace patina::reference {

void TruthTable::add(const std::string& what, double truth, double found, double tolerance) {
    EXPECT_NEAR(found, truth, tolerance) << what;
    m_rows.push_back({what, truth, found, tolerance});
}

std::string TruthTable::text(const Row& row) {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, " | %.5f | %.5f | %.5f |", row.truth, row.found,
                  row.tolerance);
    return "| " + row.what + numbers;
}

void TruthTable::expectIn(const std::string& file) const {
    std::ifstream stream(file);
    std::stringstream all;
    all << stream.rdbuf();
    const std::string docs = all.str();
    std::string wanted;
    bool same = true;
    for (const Row& row : m_rows) {
        wanted += text(row) + "\n";
        const std::string begin = "| " + row.what + " | ";
        const std::size_t at = docs.find(begin);
        double truth = 0.0, found = 0.0, tolerance = 0.0;
        same &= at != std::string::npos &&
                std::sscanf(docs.c_str() + at + begin.size(), "%lf | %lf | %lf |", &truth, &found,
                            &tolerance) == 3 &&
                std::abs(truth - row.truth) < 1e-5 && std::abs(tolerance - row.tolerance) < 1e-5 &&
                std::abs(found - row.found) <= 0.2 * row.tolerance;
    }
    EXPECT_TRUE(same) << file << " should say\n" << wanted;
}

} // namespace patina::reference

// CHECK(condition) and CHECK_EQ/LT/LE(a, b) state what must hold unless Patina itself is wrong.
// A failed check prints both operands and aborts: continuing would only hide the fault.
#pragma once

#include <fmt/format.h>
#include <string>

namespace patina::detail {
[[noreturn]] void checkFailed(const char* file, int line, const char* expression,
                              const std::string& operands);
} // namespace patina::detail

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition))                                                                          \
            ::patina::detail::checkFailed(__FILE__, __LINE__, #condition, {});                     \
    } while (false)

#define PATINA_CHECK_OP(a, op, b)                                                                  \
    do {                                                                                           \
        const auto& checkA = (a);                                                                  \
        const auto& checkB = (b);                                                                  \
        if (!(checkA op checkB))                                                                   \
            ::patina::detail::checkFailed(__FILE__, __LINE__, #a " " #op " " #b,                   \
                                          fmt::format("{} vs {}", checkA, checkB));                \
    } while (false)

#define CHECK_EQ(a, b) PATINA_CHECK_OP(a, ==, b)
#define CHECK_LT(a, b) PATINA_CHECK_OP(a, <, b)
#define CHECK_LE(a, b) PATINA_CHECK_OP(a, <=, b)

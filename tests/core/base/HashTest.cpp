#include "core/base/Hash.h"

#include <gtest/gtest.h>

using namespace patina;

TEST(Hash, SizesAndOrderMatter) {
    const auto of = [](auto... texts) {
        Hasher hasher;
        (hasher.text(texts), ...);
        return hasher.finish();
    };
    EXPECT_EQ(of("ab", "c"), of("ab", "c"));
    EXPECT_NE(of("ab", "c"), of("a", "bc"));
    EXPECT_NE(of("a", "b"), of("b", "a"));
    EXPECT_EQ(of("a").hex().size(), 32u);
}

TEST(Hash, ZeroSignDoesNotMatter) {
    EXPECT_EQ(Hasher().value(0.0f).finish(), Hasher().value(-0.0f).finish());
    EXPECT_NE(Hasher().value(0.0f).finish(), Hasher().value(1.0f).finish());
}

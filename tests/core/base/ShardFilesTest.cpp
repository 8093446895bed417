#include "core/base/ShardFiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace patina {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Error refusalOf(const std::vector<ShardFile>& files) {
    const Result<void> result = checkShardFiles(files);
    EXPECT_FALSE(result.ok());
    return result ? Error() : result.error();
}

TEST(ShardFiles, AreThereOnceEach) {
    EXPECT_TRUE(checkShardFiles(std::vector<ShardFile>{{"a", 0, 1}}));
    EXPECT_TRUE(checkShardFiles(std::vector<ShardFile>{{"c", 2, 3}, {"a", 0, 3}, {"b", 1, 3}}));

    const Error twice = refusalOf({{"a", 0, 2}, {"b", 1, 2}, {"again", 0, 2}});
    EXPECT_EQ(twice.kind, ErrorKind::InputBroken);
    EXPECT_EQ(twice.file, "again");
    EXPECT_THAT(twice.message, HasSubstr("it is part 1 of 2, and so is a"));
    const Error other = refusalOf({{"a", 0, 2}, {"c", 2, 3}});
    EXPECT_EQ(other.file, "c");
    EXPECT_THAT(other.message, HasSubstr("it is one of 3 parts, a is one of 2"));

    const Error one = refusalOf({{"a", 0, 2}});
    EXPECT_EQ(one.kind, ErrorKind::InputMissing);
    EXPECT_EQ(one.message, "of 2 parts, 2 is missing; name it too");
    EXPECT_EQ(refusalOf({{"b", 1, 4}, {"c", 2, 4}}).message,
              "of 4 parts, 1, 4 are missing; name them too");
    // As many as a file may say that there are.
    EXPECT_THAT(refusalOf({{"a", 0, 2'147'483'647}}).message,
                AllOf(HasSubstr("2, 3, 4, "), HasSubstr("21 and 2147483626 more are missing"),
                      Not(HasSubstr("22"))));
}

} // namespace
} // namespace patina

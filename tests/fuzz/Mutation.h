// Damage of all kinds to the bytes of a file. What comes of a seed follows from the random numbers
// alone.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace patina::test {

using Random = std::mt19937_64;

// Truncated, spliced with another seed, bits and numbers of the kind that sizes are made of.
[[nodiscard]] std::string mutateBytes(const std::vector<std::string>& seeds, Random& random);

// As texts go wrong: numbers that nobody would write, lines and words that are missing, repeated or
// elsewhere, brackets within brackets. Some of it is as mutateBytes().
[[nodiscard]] std::string mutateText(const std::vector<std::string>& seeds, Random& random);

// Files that carry a hash of themselves are mutated inside of it, else nothing behind the hash is
// reached. One in four is not.

// PNG: each chunk has a sum.
[[nodiscard]] std::string mutatePng(const std::vector<std::string>& seeds, Random& random);
// CacheFolder: the content, and its hash.
[[nodiscard]] std::string mutateCached(const std::vector<std::string>& seeds, Random& random);
// StateFile: the description has a hash of its own.
[[nodiscard]] std::string mutateState(const std::vector<std::string>& seeds, Random& random);
// RecoveryRecord: text, and the digits of its hash.
[[nodiscard]] std::string mutateRecord(const std::vector<std::string>& seeds, Random& random);

} // namespace patina::test

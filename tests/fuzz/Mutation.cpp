#include "tests/fuzz/Mutation.h"

#include "core/base/Hash.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <span>

namespace patina::test {
namespace {

constexpr std::size_t kHash = sizeof(Hash);

std::size_t below(Random& random, std::size_t n) {
    return n == 0 ? 0 : random() % n;
}

std::string_view asText(const Hash& hash) {
    return {reinterpret_cast<const char*>(&hash), kHash};
}

Hash hashOf(std::string_view text) {
    return hashBytes(std::as_bytes(std::span(text.data(), text.size())));
}

// Where a number of the text begins; npos: it has none.
std::size_t someNumber(const std::string& text, Random& random) {
    const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    const std::size_t from = below(random, text.size());
    auto found =
        std::find_if(text.begin() + static_cast<std::ptrdiff_t>(from), text.end(), isDigit);
    if (found == text.end())
        found = std::find_if(text.begin(), text.end(), isDigit);
    if (found == text.end())
        return std::string::npos;
    auto at = static_cast<std::size_t>(found - text.begin());
    const auto isPart = [&](char c) {
        return isDigit(c) || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
    };
    while (at > 0 && isPart(text[at - 1]))
        --at;
    return at;
}

void replaceNumber(std::string& text, Random& random) {
    static constexpr std::array<std::string_view, 22> kNumbers{
        "0",           "-1",
        "1",           "2",
        "65536",       "-0.0",
        "1e-45",       "1e-30",
        "1e30",        "1e300",
        "-1e300",      "1e999",
        "nan",         "2147483647",
        "-2147483648", "4294967296",
        "1000000000",  "9223372036854775807",
        "null",        "true",
        "\"x\"",       "18446744073709551615"};
    const std::size_t at = someNumber(text, random);
    if (at == std::string::npos)
        return;
    std::size_t end = at;
    while (end < text.size() &&
           std::string_view("0123456789.+-eE").find(text[end]) != std::string_view::npos)
        ++end;
    text.replace(at, end - at, kNumbers[below(random, kNumbers.size())]);
}

// A piece of the text, by lines or by words.
std::pair<std::size_t, std::size_t> somePiece(const std::string& text, Random& random) {
    const char* ends = below(random, 2) == 0 ? "\n" : " ,\n\t";
    const std::size_t somewhere = below(random, text.size());
    std::size_t begin = text.find_last_of(ends, somewhere);
    begin = begin == std::string::npos ? 0 : begin + 1;
    std::size_t end = text.find_first_of(ends, somewhere);
    end = end == std::string::npos ? text.size() : end + 1;
    return {std::min(begin, end), end};
}

} // namespace

std::string mutateBytes(const std::vector<std::string>& seeds, Random& random) {
    std::string bytes = seeds[below(random, seeds.size())];
    if (bytes.empty())
        return bytes;
    switch (below(random, 5)) {
    case 0:
        bytes.resize(below(random, bytes.size()));
        break;
    case 1:
        for (std::size_t i = 0, n = 1 + below(random, 16); i < n; ++i)
            bytes[below(random, bytes.size())] ^= static_cast<char>(1 << below(random, 8));
        break;
    case 2: {
        const std::string& other = seeds[below(random, seeds.size())];
        bytes = bytes.substr(0, below(random, bytes.size())) +
                other.substr(below(random, other.size()));
        break;
    }
    case 3: {
        static constexpr std::array<std::uint32_t, 8> kNumbers{
            0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0xffff, 0x7fc00000, 0x7f800000};
        for (std::size_t n = 1 + below(random, 3); n > 0; --n) {
            const std::uint32_t value = kNumbers[below(random, kNumbers.size())];
            const std::size_t at = below(random, bytes.size());
            for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
                bytes[at + i] = static_cast<char>(value >> (8 * i));
        }
        break;
    }
    default: {
        const std::size_t at = below(random, bytes.size());
        const std::size_t length = std::min(bytes.size() - at, 1 + below(random, 64));
        const std::size_t how = below(random, 3);
        if (how == 0)
            bytes.erase(at, length);
        else if (how == 1)
            bytes.insert(at, bytes.substr(at, length));
        else
            for (std::size_t i = 0; i < length; ++i)
                bytes[at + i] = static_cast<char>(random());
        break;
    }
    }
    return bytes;
}

std::string mutateText(const std::vector<std::string>& seeds, Random& random) {
    if (below(random, 5) == 0)
        return mutateBytes(seeds, random);
    std::string text = seeds[below(random, seeds.size())];
    for (std::size_t n = 1 + below(random, 3); n > 0 && !text.empty(); --n) {
        const auto [begin, end] = somePiece(text, random);
        switch (below(random, 8)) {
        case 0:
            text.erase(begin, end - begin);
            break;
        case 1:
            text.insert(begin, text.substr(begin, end - begin));
            break;
        case 2: { // elsewhere
            const std::string piece = text.substr(begin, end - begin);
            text.erase(begin, end - begin);
            text.insert(below(random, text.size() + 1), piece);
            break;
        }
        case 3: {
            static constexpr std::array<char, 5> kOpen{'[', '{', '<', '(', '"'};
            text.insert(begin,
                        std::string(1 + below(random, 2000), kOpen[below(random, kOpen.size())]));
            break;
        }
        default:
            replaceNumber(text, random);
            break;
        }
    }
    return text;
}

std::string mutatePng(const std::vector<std::string>& seeds, Random& random) {
    std::string file = mutateBytes(seeds, random);
    if (below(random, 4) == 0)
        return file;
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(file[i]); };
    constexpr std::size_t kSignature = 8, kHead = 8, kSum = 4; // of a chunk: length, name … sum
    for (std::size_t chunk = kSignature; chunk + kHead + kSum <= file.size();) {
        const std::size_t length =
            std::size_t{at(chunk)} << 24 | at(chunk + 1) << 16 | at(chunk + 2) << 8 | at(chunk + 3);
        if (length > file.size() - chunk - kHead - kSum)
            break;
        std::uint32_t sum = 0xffffffff; // of the name and what follows, as zlib's crc32()
        for (std::size_t i = chunk + 4; i < chunk + kHead + length; ++i) {
            sum ^= at(i);
            for (int bit = 0; bit < 8; ++bit)
                sum = sum >> 1 ^ (0xedb88320u & (0u - (sum & 1u)));
        }
        chunk += kHead + length;
        for (std::size_t i = 0; i < kSum; ++i)
            file[chunk + i] = static_cast<char>(~sum >> (8 * (3 - i)));
        chunk += kSum;
    }
    return file;
}

std::string mutateCached(const std::vector<std::string>& seeds, Random& random) {
    if (below(random, 4) == 0)
        return mutateBytes(seeds, random);
    std::vector<std::string> contents;
    for (const std::string& seed : seeds)
        contents.push_back(seed.substr(0, seed.size() - std::min(seed.size(), kHash)));
    // Headers are small, and what they say decides of the rest.
    std::string content = mutateBytes(contents, random);
    if (below(random, 2) == 0 && content.size() > 64) {
        const std::string head = mutateBytes({content.substr(0, 64)}, random);
        content = head + content.substr(64);
    }
    return content + std::string(asText(hashOf(content)));
}

std::string mutateState(const std::vector<std::string>& seeds, Random& random) {
    constexpr std::size_t kPrologue = 16;
    const std::string& seed = seeds[below(random, seeds.size())];
    std::uint32_t size = 0;
    if (below(random, 4) == 0 || seed.size() < kPrologue + kHash)
        return mutateBytes(seeds, random);
    std::memcpy(&size, seed.data() + 12, sizeof size);
    const std::string text = mutateText({seed.substr(kPrologue, size)}, random);
    const auto written = static_cast<std::uint32_t>(text.size());
    std::string file = seed.substr(0, kPrologue);
    std::memcpy(file.data() + 12, &written, sizeof written);
    const std::size_t rest = std::min(seed.size(), kPrologue + size + kHash);
    return file + text + std::string(asText(hashOf(text))) + seed.substr(rest);
}

std::string mutateRecord(const std::vector<std::string>& seeds, Random& random) {
    if (below(random, 4) == 0)
        return mutateText(seeds, random);
    const std::string& seed = seeds[below(random, seeds.size())];
    const std::string text =
        mutateText({seed.substr(0, seed.size() - std::min(seed.size(), 2 * kHash))}, random);
    return text + hashOf(text).hex();
}

} // namespace patina::test

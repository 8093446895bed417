#include "core/codec/model/ObjText.h"

#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <iterator>
#include <span>

namespace patina::codec {

namespace {

constexpr int kMostDigits = 9;
constexpr std::array<double, 16> kDecimals{0.0,  1e-1, 1e-2,  1e-3,  1e-4,  1e-5,  1e-6,  1e-7,
                                           1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15};
constexpr std::size_t kMostRuns = 1 << 24; // a float counts them one by one up to here

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

bool isBlank(char c) {
    return c == ' ' || c == '\t';
}

// Reads line by line. Each function that returns bool says whether what it met is plain. The text
// ends in a line feed, which no token reaches beyond.
class Scanner {
  public:
    explicit Scanner(std::string_view text)
        : m_at(text.data())
        , m_end(text.data() + text.size()) {}

    std::optional<ObjText> read() {
        while (m_at < m_end)
            if (!line())
                return std::nullopt;
        return std::move(m_text);
    }

  private:
    bool line() {
        while (isBlank(*m_at))
            ++m_at;
        switch (*m_at) {
        case 'v':
            return vertex();
        case 'f':
            return isBlank(m_at[1]) && face();
        case 'c': // curves may enclose other statements
        case 'l':
        case 'p':
            return false;
        default:
            return other();
        }
    }

    bool vertex() {
        const char kind = m_at[1];
        if (isBlank(kind)) {
            ++m_at;
            return position();
        }
        if ((kind != 't' && kind != 'n') || !isBlank(m_at[2]))
            return other();
        m_at += 2;
        std::array<float, 3> v{};
        const int count = numbers(v);
        if (kind == 'n') {
            m_text.normals.emplace_back(v[0], v[1], v[2]);
            return count == 3;
        }
        m_text.uvs.emplace_back(v[0], 1.0f - v[1]);
        return count == 2 || (count == 3 && v[2] == 0.0f);
    }

    // "x y z", "x y z w" or "x y z red green blue".
    bool position() {
        std::array<float, 6> v{};
        const int count = numbers(v);
        glm::vec3 p(v[0], v[1], v[2]);
        if (count == 4)
            p = {v[0] / v[3], v[1] / v[3], v[2] / v[3]};
        m_text.positions.push_back(p);
        m_text.vertexColors = m_text.vertexColors || count == 6;
        return (count == 3 || count == 4 || count == 6) && std::isfinite(p.x) &&
               std::isfinite(p.y) && std::isfinite(p.z);
    }

    // How many numbers stand in the rest of the line, which ends after them; -1 where it holds
    // anything else or more.
    int numbers(std::span<float> values) {
        for (std::size_t count = 0;; ++count) {
            while (isBlank(*m_at))
                ++m_at;
            if (lineEnd())
                return static_cast<int>(count);
            if (count == values.size() || !number(values[count]))
                return -1;
        }
    }

    // In Assimp's arithmetic, which does not round to the nearest: positions name bakes.
    bool number(float& value) {
        const bool negative = *m_at == '-';
        m_at += negative || *m_at == '+' ? 1 : 0;
        std::uint64_t whole = 0;
        if (!digits(whole, kMostDigits))
            return false;
        value = static_cast<float>(whole);
        if (*m_at == '.') {
            const char* const first = ++m_at;
            std::uint64_t decimals = 0;
            for (; isDigit(*m_at) && m_at - first < static_cast<int>(kDecimals.size()) - 1; ++m_at)
                decimals = 10 * decimals + static_cast<std::uint64_t>(*m_at - '0');
            if (m_at > first)
                value += static_cast<float>(static_cast<double>(decimals) *
                                            kDecimals[static_cast<std::size_t>(m_at - first)]);
            while (isDigit(*m_at))
                ++m_at;
        }
        if (*m_at == 'e' || *m_at == 'E') {
            ++m_at;
            const bool small = *m_at == '-';
            m_at += small || *m_at == '+' ? 1 : 0;
            std::uint64_t exponent = 0;
            if (!digits(exponent, kMostDigits))
                return false;
            value *= std::pow(10.0f,
                              small ? -static_cast<float>(exponent) : static_cast<float>(exponent));
        }
        value = negative ? -value : value;
        return std::isfinite(value) && atTokenEnd();
    }

    // At least one and at most `most`.
    bool digits(std::uint64_t& value, int most) {
        const char* const first = m_at;
        for (; isDigit(*m_at) && m_at - first < most; ++m_at)
            value = 10 * value + static_cast<std::uint64_t>(*m_at - '0');
        return m_at > first && !isDigit(*m_at);
    }

    [[nodiscard]] bool atTokenEnd() const {
        return isBlank(*m_at) || *m_at == '\n' || *m_at == '\r';
    }

    // Steps over the end of a line, where the text is at one.
    bool lineEnd() {
        if (*m_at == '\n') {
            ++m_at;
            return true;
        }
        if (*m_at == '\r' && m_at[1] == '\n') {
            m_at += 2;
            return true;
        }
        return false;
    }

    bool face() {
        ++m_at;
        std::array<ObjText::Corner, 4> corners{};
        std::size_t count = 0;
        for (;; ++count) {
            while (isBlank(*m_at))
                ++m_at;
            if (lineEnd())
                break;
            if (count == corners.size() || !corner(corners[count]))
                return false;
            // Indices that some corners lack would be counted off from the first corner on.
            if ((corners[count].uv == ObjText::kNone) != (corners[0].uv == ObjText::kNone) ||
                (corners[count].normal == ObjText::kNone) != (corners[0].normal == ObjText::kNone))
                return false;
        }
        if (count < 3 || (!m_inRun && !beginRun()))
            return false;
        m_text.corners.insert(m_text.corners.end(), corners.begin(),
                              corners.begin() + static_cast<std::ptrdiff_t>(count));
        m_text.cornerCounts.push_back(static_cast<std::uint8_t>(count));
        return true;
    }

    bool beginRun() {
        if (m_text.runs.size() == kMostRuns)
            return false;
        const std::size_t run = m_text.runs.size();
        m_text.runs.push_back({m_text.cornerCounts.size(), m_text.corners.size()});
        fmt::format_to(std::back_inserter(m_text.outline), "v {0} 0 0\nf {1} {1} {1}\n", run,
                       run + 1);
        m_inRun = true;
        return true;
    }

    // "1", "1/2", "1//3" or "1/2/3".
    bool corner(ObjText::Corner& corner) {
        if (!index(corner.position, m_text.positions.size()))
            return false;
        if (*m_at == '/') {
            ++m_at;
            if (*m_at != '/' && !index(corner.uv, m_text.uvs.size()))
                return false;
            if (*m_at == '/') {
                ++m_at;
                if (!index(corner.normal, m_text.normals.size()))
                    return false;
            }
        }
        return atTokenEnd();
    }

    // Of something that was read before: what comes later could still be named, but nobody does.
    bool index(std::uint32_t& result, std::size_t count) {
        const bool fromEnd = *m_at == '-';
        m_at += fromEnd ? 1 : 0;
        std::uint64_t value = 0;
        if (*m_at == '0' || !digits(value, kMostDigits) || value > count)
            return false;
        result = static_cast<std::uint32_t>(fromEnd ? count - value : value - 1);
        return true;
    }

    // Goes into the outline as it stands, unless it would run on into the next line, or is two.
    bool other() {
        const auto left = static_cast<std::size_t>(m_end - m_at);
        const char* const feed = static_cast<const char*>(std::memchr(m_at, '\n', left));
        std::string_view line(m_at, static_cast<std::size_t>(feed - m_at));
        m_at = feed + 1;
        if (line.ends_with('\r'))
            line.remove_suffix(1);
        using namespace std::string_view_literals;
        if (line.ends_with('\\') || line.find_first_of("\r\f\0"sv) != std::string_view::npos)
            return false;
        if (line.empty() || line.front() == '#')
            return true;
        m_inRun = false;
        m_text.outline += line;
        m_text.outline += '\n';
        return true;
    }

    const char* m_at;
    const char* m_end;
    bool m_inRun = false;
    ObjText m_text;
};

} // namespace

std::optional<ObjText> readObjText(std::string_view text) {
    if (!text.ends_with('\n'))
        return std::nullopt;
    return Scanner(text).read();
}

} // namespace patina::codec

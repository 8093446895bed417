#include "core/mesh/BorderSweep.h"

#include <algorithm>
#include <cstddef>
#include <set>

namespace patina {
namespace {

bool precedes(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}

// Twice the area of a triangle. Differences of coordinates near 1 and their products are off by
// some 1e-19 in long double.
long double areaOf(const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
    using Wide = long double;
    return (Wide(q.x) - Wide(p.x)) * (Wide(r.y) - Wide(p.y)) -
           (Wide(q.y) - Wide(p.y)) * (Wide(r.x) - Wide(p.x));
}

// -1 and 1: r lies to the right or left of the line from p to q; 0: too near to say.
int sideOf(const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
    constexpr long double kCertain = 1e-17L;
    const long double area = areaOf(p, q, r);
    return area > kCertain ? 1 : area < -kCertain ? -1 : 0;
}

class Sweep {
  public:
    explicit Sweep(const std::vector<BorderSegment>& border) {
        for (const BorderSegment& segment : border) {
            const auto& [from, to] = segment;
            if (from == to)
                continue;
            const bool forward = precedes(from, to);
            m_segments.push_back({forward ? from : to, forward ? to : from, forward ? 1 : -1});
        }
    }

    bool windsAtMostOnce() {
        std::vector<Event> events;
        events.reserve(2 * m_segments.size());
        for (std::size_t i = 0; i < m_segments.size(); ++i) {
            events.push_back({m_segments[i].left, i, true});
            events.push_back({m_segments[i].right, i, false});
        }
        std::ranges::sort(events, [](const Event& a, const Event& b) {
            if (a.at != b.at)
                return precedes(a.at, b.at);
            return a.begins != b.begins ? b.begins : a.segment < b.segment; // ends first
        });
        m_crossed.assign(m_segments.size(), m_crossing.end());
        for (std::size_t begin = 0, end = 0; begin < events.size(); begin = end) {
            while (end < events.size() && events[end].at == events[begin].at)
                ++end;
            if (!pass({events.data() + begin, events.data() + end}))
                return false;
        }
        return true;
    }

  private:
    struct Segment {
        glm::dvec2 left, right;
        int winding; // above it, less that below
        int above = 0;
    };
    struct Event {
        glm::dvec2 at;
        std::size_t segment;
        bool begins;
    };
    struct Below {
        Sweep* sweep;
        bool operator()(std::size_t a, std::size_t b) const { return sweep->isBelow(a, b); }
    };
    using Crossing = std::set<std::size_t, Below>;

    // Both are crossed by one vertical line.
    bool isBelow(std::size_t a, std::size_t b) {
        if (a == b)
            return false;
        const Segment &s = m_segments[a], &t = m_segments[b];
        if (precedes(t.left, s.left))
            return sideFrom(t, s) < 0;
        return sideFrom(s, t) > 0;
    }

    // Of t, which begins no sooner than s does.
    int sideFrom(const Segment& s, const Segment& t) {
        int side = s.left == t.left ? 0 : sideOf(s.left, s.right, t.left);
        if (side == 0 && s.left == t.left)
            side = precedes(t.right, s.right) ? sideOf(s.left, s.right, t.right)
                                              : -sideOf(t.left, t.right, s.right);
        m_unclear = m_unclear || side == 0;
        return side;
    }

    // Whether two segments have no point in common but ends.
    [[nodiscard]] bool areApart(std::size_t a, std::size_t b) const {
        const Segment &s = m_segments[a], &t = m_segments[b];
        const bool sameLeft = s.left == t.left, sameRight = s.right == t.right;
        if (sameLeft && sameRight)
            return false;
        if (s.right == t.left || t.right == s.left)
            return true;
        if (sameLeft)
            return sideOf(s.left, s.right, t.right) != 0;
        if (sameRight)
            return sideOf(s.left, s.right, t.left) != 0;
        const auto onOneSide = [](const Segment& line, const Segment& other) {
            return sideOf(line.left, line.right, other.left) *
                       sideOf(line.left, line.right, other.right) >
                   0;
        };
        return onOneSide(s, t) || onOneSide(t, s);
    }

    // All segments that end at a point, then all that begin there.
    bool pass(std::pair<const Event*, const Event*> events) {
        const Event *const first = events.first, *const last = events.second;
        for (const Event* event = first; event != last; ++event)
            if (!(event->begins ? begin(event->segment) : end(event->segment)))
                return false;
        if (!first->begins && !(last - 1)->begins)
            return true;
        // Those that begin lie one above the other.
        auto lowest = m_crossed[(last - 1)->segment];
        const auto beginsHere = [&](std::size_t segment) {
            return m_segments[segment].left == first->at;
        };
        while (lowest != m_crossing.begin() && beginsHere(*std::prev(lowest)))
            --lowest;
        int winding = lowest == m_crossing.begin() ? 0 : m_segments[*std::prev(lowest)].above;
        for (auto at = lowest; at != m_crossing.end() && beginsHere(*at); ++at) {
            winding += m_segments[*at].winding;
            m_segments[*at].above = winding;
            if (winding < 0 || winding > 1)
                return false;
        }
        return true;
    }

    bool begin(std::size_t segment) {
        const auto [at, isNew] = m_crossing.insert(segment);
        if (!isNew || m_unclear)
            return false;
        m_crossed[segment] = at;
        const auto next = std::next(at);
        return (at == m_crossing.begin() || areApart(*std::prev(at), segment)) &&
               (next == m_crossing.end() || areApart(segment, *next));
    }

    bool end(std::size_t segment) {
        const auto next = m_crossing.erase(m_crossed[segment]);
        return next == m_crossing.begin() || next == m_crossing.end() ||
               areApart(*std::prev(next), *next);
    }

    std::vector<Segment> m_segments;
    bool m_unclear = false;
    Crossing m_crossing{Below{this}}; // by the line, from below
    std::vector<Crossing::iterator> m_crossed;
};

} // namespace

bool windsAtMostOnce(const std::vector<BorderSegment>& border) {
    return Sweep(border).windsAtMostOnce();
}

} // namespace patina

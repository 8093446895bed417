#include "app/editor/trace/PassTurn.h"

#include <algorithm>

namespace patina::editor {

std::optional<std::size_t> nextTurn(std::span<const PassTurn> pictures) {
    std::uint64_t newest = 0;
    for (const PassTurn& picture : pictures)
        newest = std::max(newest, picture.last);
    const auto hadLast = [&](const PassTurn& picture) {
        return newest > 0 && picture.last == newest;
    };
    const auto isBefore = [&](const PassTurn& a, const PassTurn& b) {
        if (hadLast(a) != hadLast(b))
            return hadLast(b);
        return a.coarseness != b.coarseness ? a.coarseness > b.coarseness : a.last < b.last;
    };
    std::optional<std::size_t> next;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        if (pictures[i].wants && (!next || isBefore(pictures[i], pictures[*next])))
            next = i;
    return next;
}

} // namespace patina::editor

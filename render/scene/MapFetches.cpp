#include "render/scene/MapFetches.h"

#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>

namespace patina::render {

namespace {

constexpr std::size_t kPackedChannels = 4; // of a texture

// Of a map that reads one channel: R, G, B or A of its texture; Rgb means red.
int textureChannel(MapChannel channel) {
    switch (channel) {
    case MapChannel::Rgb:
    case MapChannel::R:
        return 0;
    case MapChannel::G:
        return 1;
    case MapChannel::B:
        return 2;
    case MapChannel::A:
        return 3;
    }
    return 0;
}

// Where the image stores that channel: one channel is grey, two are grey and alpha. Nothing where
// it stores none: an alpha that is 1 everywhere.
std::optional<int> storedChannel(const Image& image, MapChannel channel) {
    const int wanted = textureChannel(channel), stored = image.channels();
    if (stored >= 3)
        return wanted < stored ? std::optional(wanted) : std::nullopt;
    if (wanted < 3)
        return 0;
    return stored == 2 ? std::optional(1) : std::nullopt;
}

bool samePlace(const MapSlot& a, const MapSlot& b) {
    return a.uvScale == b.uvScale && a.uvOffset == b.uvOffset && a.uvRotationDeg == b.uvRotationDeg;
}

// Whether channels of both may lie in one texture.
bool packTogether(const Image& a, const Image& b) {
    const auto packable = [](const Image& image) {
        return image.encoding() != ColorEncoding::Srgb &&
               texelPrecision(image) != TexelPrecision::F16;
    };
    return packable(a) && packable(b) && a.width() == b.width() && a.height() == b.height() &&
           texelPrecision(a) == texelPrecision(b);
}

// Inputs that share a fetch, in the making.
class SharedFetch {
  public:
    SharedFetch(MaterialInput input, const MapSlot& map)
        : m_map(map) {
        add(input, map);
    }

    // Adds a further map unless it lies elsewhere or cannot be packed with the others.
    [[nodiscard]] bool take(MaterialInput input, const MapSlot& map) {
        if (!samePlace(m_map, map))
            return false;
        const bool sameImage =
            std::ranges::all_of(m_members, [&](const Member& m) { return m.image == map.image; });
        if (!sameImage && !packs(map))
            return false;
        add(input, map);
        return true;
    }

    void store(PerInput<std::optional<MapFetch>>& fetches) const {
        const MaterialInput owner = m_members.front().input;
        const bool whole =
            std::ranges::all_of(m_members, [&](const Member& m) { return m.image == m_map.image; });
        for (const Member& member : m_members) {
            MapFetch& fetch = fetches[member.input].emplace();
            fetch.owner = owner;
            fetch.channel = whole ? member.inTexture : placeOf(member);
        }
        TexelSource& texture = fetches[owner]->texture;
        if (whole)
            texture.image = m_map.image;
        else
            texture.packed = m_channels;
    }

  private:
    struct Member {
        MaterialInput input;
        ImagePtr image;
        int inTexture = 0;            // channel of the whole image's texture
        std::optional<int> inStorage; // channel of the image
    };

    [[nodiscard]] bool packs(const MapSlot& map) const {
        const std::optional<int> channel = storedChannel(*map.image, map.channel);
        const bool stored = channel && std::ranges::all_of(m_members, [](const Member& m) {
                                return m.inStorage.has_value();
                            });
        if (!stored || !packTogether(*m_map.image, *map.image))
            return false;
        const bool isThere = std::ranges::count(m_channels, ImageChannel{map.image, *channel}) > 0;
        return isThere || m_channels.size() < kPackedChannels;
    }

    void add(MaterialInput input, const MapSlot& map) {
        const std::optional<int> channel = storedChannel(*map.image, map.channel);
        m_members.push_back({input, map.image, textureChannel(map.channel), channel});
        if (channel && std::ranges::count(m_channels, ImageChannel{map.image, *channel}) == 0)
            m_channels.push_back({map.image, *channel});
    }

    [[nodiscard]] int placeOf(const Member& member) const {
        const auto found =
            std::ranges::find(m_channels, ImageChannel{member.image, *member.inStorage});
        return static_cast<int>(found - m_channels.begin());
    }

    const MapSlot& m_map; // of the first member
    std::vector<Member> m_members;
    std::vector<ImageChannel> m_channels; // of all members, each once
};

} // namespace

TexelPrecision texelPrecision(const Image& image) {
    switch (image.type()) {
    case PixelType::U8:
        return TexelPrecision::U8;
    case PixelType::U16:
        return TexelPrecision::U16;
    case PixelType::F32:
        break;
    }
    return image.channels() <= 2 ? TexelPrecision::F32 : TexelPrecision::F16;
}

PerInput<std::optional<MapFetch>> mapFetches(const Material& material) {
    PerInput<std::optional<MapFetch>> fetches;
    std::vector<SharedFetch> shared;
    const auto takeAll = [&](InputRole role) {
        for (const MaterialInputInfo& info : kMaterialInputs) {
            const MapSlot& map = material.*info.map;
            if (info.role != role || !map.image)
                continue;
            const bool taken = std::ranges::any_of(
                shared, [&](SharedFetch& fetch) { return fetch.take(info.input, map); });
            if (!taken)
                shared.emplace_back(info.input, map);
        }
    };
    takeAll(InputRole::Number); // first: they own what occlusion shares with them
    takeAll(InputRole::Occlusion);
    for (const SharedFetch& fetch : shared)
        fetch.store(fetches);
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (const MapSlot& map = material.*info.map; map.image && !readsOneChannel(info))
            fetches[info.input] = MapFetch{info.input, 0, {map.image, {}}};
    return fetches;
}

} // namespace patina::render

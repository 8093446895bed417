#include "core/bake/file/BakePacking.h"

#include "core/bake/file/BakeHeader.h"
#include "core/bake/file/BakeParts.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace patina {

static_assert(kPackedBakeVersion > kBakeFormatVersion);

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kVersionKey = "patina:version";
// Of a packed part: its description stays some hundred kilobytes long, its pixels some hundred
// megabytes.
constexpr std::size_t kMaxMembers = 1024;
constexpr std::size_t kMaxPixels = std::size_t{1} << 25;

std::size_t pixelsOf(const Image& image) {
    return static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
}

std::size_t rowsOf(std::size_t pixels) {
    return (pixels + kMaxBakeRow - 1) / static_cast<std::size_t>(kMaxBakeRow);
}

ImagePart packed(std::vector<ImagePart> members, std::size_t number) {
    ImagePart part;
    part.name = fmt::format("packed {}", number);
    part.attributes = members.front().attributes;
    for (const ImagePart& member : members)
        std::erase_if(part.attributes, [&](const auto& attribute) {
            const auto own = member.attributes.find(attribute.first);
            return own == member.attributes.end() || own->second != attribute.second;
        });
    const auto version = part.attributes.find(kVersionKey);

    std::size_t pixels = 0;
    for (const ImagePart& member : members)
        pixels += pixelsOf(member.image);
    const Image& first = members.front().image;
    const auto channels = static_cast<std::size_t>(first.channels());
    part.image = Image(kMaxBakeRow, static_cast<int>(rowsOf(pixels)), first.channels(),
                       PixelType::F32, first.encoding());
    part.image.setChannelNames(first.channelNames());

    Json description = Json::array();
    std::size_t at = 0;
    for (ImagePart& member : members) {
        Json entry = {{"name", member.name},
                      {"first", at},
                      {"width", member.image.width()},
                      {"height", member.image.height()}};
        for (const auto& [key, value] : member.attributes)
            if (!part.attributes.contains(key))
                entry[key] = value;
        if (version != part.attributes.end())
            entry[kVersionKey] = version->second;
        description.push_back(std::move(entry));
        std::ranges::copy(
            member.image.f32(),
            part.image.f32().subspan(at * channels, member.image.f32().size()).begin());
        at += pixelsOf(member.image);
        member.image = {};
    }
    part.attributes[kVersionKey] = std::to_string(kPackedBakeVersion);
    part.attributes[kPackedAttribute] = description.dump();
    return part;
}

} // namespace

std::vector<ImagePart> packParts(std::vector<ImagePart> parts, std::size_t maxPlain) {
    if (parts.size() <= maxPlain)
        return parts;
    // Members in the order of the parts; a new packed part where channels differ or one is full.
    struct Group {
        std::vector<ImagePart> members;
        std::size_t pixels = 0;
    };
    std::vector<Group> groups;
    std::map<std::vector<std::string>, std::size_t> open; // by channels
    for (ImagePart& part : parts) {
        const std::size_t pixels = pixelsOf(part.image);
        const auto [group, isNew] = open.try_emplace(part.image.channelNames(), groups.size());
        if (!isNew && (groups[group->second].members.size() == kMaxMembers ||
                       groups[group->second].pixels + pixels > kMaxPixels))
            group->second = groups.size();
        if (group->second == groups.size())
            groups.emplace_back();
        groups[group->second].pixels += pixels;
        groups[group->second].members.push_back(std::move(part));
    }
    std::vector<ImagePart> result;
    for (Group& group : groups)
        result.push_back(packed(std::move(group.members), result.size() + 1));
    return result;
}

bool isPacked(const ImagePart& part) {
    return part.attributes.contains(kPackedAttribute);
}

Result<std::vector<ImagePart>> unpackParts(std::vector<ImagePart> parts,
                                           const std::filesystem::path& file) {
    if (std::ranges::none_of(parts, isPacked))
        return parts;
    const auto damaged = [&] {
        return damagedBake(file, "the description of its meshes does not fit its numbers");
    };
    std::vector<ImagePart> result;
    for (ImagePart& part : parts) {
        const auto version =
            numberAttribute(part.attributes, kVersionKey, 1, 1'000'000).value_or(0);
        if (!isPacked(part) || version > kPackedBakeVersion) {
            result.push_back(std::move(part));
            continue;
        }
        if (version < kFirstPackedBakeVersion)
            return damaged();
        BakeAttributes common = part.attributes;
        common.erase(kPackedAttribute);
        const std::size_t available = pixelsOf(part.image);
        const auto channels = static_cast<std::size_t>(part.image.channels());
        const Json description = Json::parse(part.attributes[kPackedAttribute], nullptr, false);
        if (!description.is_array() || part.image.type() != PixelType::F32)
            return damaged();
        std::size_t at = 0; // members follow each other, so that they take no more than the part
        try {
            for (const Json& entry : description) {
                const auto first = entry.at("first").get<std::size_t>();
                const int width = entry.at("width").get<int>();
                const int height = entry.at("height").get<int>();
                if (width < 1 || height < 1 || first != at ||
                    static_cast<std::size_t>(height) >
                        (available - at) / static_cast<std::size_t>(width))
                    return damaged();
                at += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
                ImagePart& member = result.emplace_back();
                member.name = entry.at("name").get<std::string>();
                member.attributes = common;
                for (const auto& [key, value] : entry.items())
                    if (key.starts_with("patina:"))
                        member.attributes[key] = value.get<std::string>();
                member.image = Image(width, height, part.image.channels(), PixelType::F32,
                                     part.image.encoding());
                member.image.setChannelNames(part.image.channelNames());
                std::ranges::copy(
                    part.image.f32().subspan(first * channels, member.image.f32().size()),
                    member.image.f32().begin());
            }
        } catch (const nlohmann::json::exception&) {
            return damaged();
        }
        part.image = {};
    }
    return result;
}

} // namespace patina

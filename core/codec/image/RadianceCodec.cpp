// Radiance files in the worker's protocol.
#include "core/codec/image/ImageCodec.h"
#include "core/codec/image/RadianceHdr.h"
#include "core/image/AreaFilter.h"

#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::codec {

using nlohmann::json;

Reply decodeRadiance(const json& request, int payloadFd) {
    const MemoryFile file = mapFile(payloadFd);
    const RadianceHeader header = readRadianceHeader(file.bytes());
    const ImageSize size = reducedSize({header.width, header.height}, request.value("maxSide", 0));
    checkImageSize(size.width, size.height, 3, sizeof(float));

    json attributes = json::object();
    if (header.primaries)
        attributes["chromaticities"] = fmt::format("{}", fmt::join(*header.primaries, " "));
    const bool inspect = request.value("inspect", false);
    const json part = {{"name", ""},
                       {"width", inspect ? header.width : size.width},
                       {"height", inspect ? header.height : size.height},
                       {"channels", 3},
                       {"channelNames", {"R", "G", "B"}},
                       {"stored", "float"},
                       {"attributes", attributes},
                       {"type", "f32"},
                       {"offset", 0}};
    Reply reply;
    reply.header = toJsonText({{"format", "hdr"}, {"parts", json::array({part})}});
    if (inspect) {
        reply.payload = allocate(0);
        return reply;
    }
    const std::vector<float> pixels =
        readRadiancePixels(file.bytes(), header, size.width, size.height);
    reply.payload = allocate(pixels.size() * sizeof(float));
    std::memcpy(reply.payload.writable().data(), pixels.data(), pixels.size() * sizeof(float));
    return reply;
}

Reply encodeRadiance(const json& request, std::span<const std::byte> payload) {
    const json& part = request.at("parts").at(0);
    const int width = part.at("width");
    const int height = part.at("height");
    const std::size_t samples =
        3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (part.at("channels") != 3 || part.at("type") != "f32" ||
        samples * sizeof(float) > payload.size())
        throw Refusal("the image cannot be encoded", "hdr: pixels are missing");
    std::vector<float> pixels(samples);
    std::memcpy(pixels.data(), payload.data(), samples * sizeof(float));
    const std::vector<std::byte> bytes = writeRadiance(width, height, pixels);
    Reply reply;
    reply.header = "{}";
    reply.payload = allocate(bytes.size());
    std::memcpy(reply.payload.writable().data(), bytes.data(), bytes.size());
    return reply;
}

} // namespace patina::codec

#include "core/codec/image/ImageCodec.h"

#include "core/codec/image/DecodePicture.h"
#include "core/codec/image/ExrReader.h"
#include "core/codec/image/ExrWriter.h"
#include "core/codec/image/HandOn.h"
#include "core/codec/image/JpegReader.h"
#include "core/codec/image/LuminanceChroma.h"
#include "core/codec/image/PngReader.h"
#include "core/worker/WorkerProtocol.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace patina::codec {

namespace {

using nlohmann::json;

Reply decodeLuminanceChroma(const LuminanceChromaImage& image) {
    json attributes = json::object();
    if (image.chromaticities)
        attributes["chromaticities"] = joined(*image.chromaticities);
    const json part = {{"name", ""},
                       {"width", image.width},
                       {"height", image.height},
                       {"channels", 3},
                       {"channelNames", {"R", "G", "B"}},
                       {"stored", "half"},
                       {"attributes", attributes},
                       {"type", "f32"},
                       {"offset", 0}};
    Reply reply;
    reply.header = toJsonText({{"format", "openexr"}, {"parts", json::array({part})}});
    reply.payload = allocate(image.rgb.size() * sizeof(float));
    if (!image.rgb.empty())
        std::memcpy(reply.payload.writable().data(), image.rgb.data(),
                    image.rgb.size() * sizeof(float));
    return reply;
}

// Nothing for OpenEXR files with channels of different resolutions.
std::optional<Reply> decode(const json& request, int payloadFd, const std::string& name) {
    const auto format = request.at("format").get<std::string>();
    const bool inspect = request.value("inspect", false);
    if (format == "openexr") {
        const auto reader = readExr(name);
        return reader ? std::optional(decodePicture(*reader, request, payloadFd)) : std::nullopt;
    }
    const MemoryFile file = mapFile(payloadFd);
    if (format == "png")
        return decodePicture(*readPng(file.bytes(), inspect), request, payloadFd);
    if (format == "jpeg")
        return decodePicture(*readJpeg(file.bytes(), inspect), request, payloadFd);
    throw HandOn{format};
}

} // namespace

void prepareImageCodec() {
    prepareExr();
}

Reply decodeImage(const json& request, int payloadFd) {
    if (request.at("format") == "hdr")
        return decodeRadiance(request, payloadFd);
    if (request.at("format") == "pfm")
        return decodePfm(request, payloadFd);
    const std::string name = fmt::format("/proc/self/fd/{}", payloadFd);
    bool subsampled = false;
    try {
        if (std::optional<Reply> reply = decode(request, payloadFd, name))
            return std::move(*reply);
        subsampled = true;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const HandOn&) {
        // below
    } catch (const std::exception&) {
        // Refused or damaged: in OpenImageIO's words, as other formats are.
    }
    if (subsampled)
        if (const auto image = readLuminanceChroma(name, request.value("inspect", false)))
            return decodeLuminanceChroma(*image);
    Reply reply;
    reply.header = protocol::kHandOn;
    reply.payload = allocate(0);
    return reply;
}

Reply decodeImages(const json& request, std::span<const std::byte> payload) {
    constexpr std::size_t kMostPixels = std::size_t{256} << 20; // bytes; small images have fewer
    std::vector<MemoryFile> pixels;
    std::size_t total = 0;
    json answers = json::array();
    for (const json& image : request.at("images")) {
        const auto size = image.at("size").get<std::size_t>();
        if (size > payload.size())
            throw Refusal("the images cannot be decoded", "payload");
        const std::span<const std::byte> bytes = payload.first(size);
        payload = payload.subspan(size);
        auto file = total < kMostPixels ? MemoryFile::copyOf(bytes) : std::nullopt;
        if (!file) {
            answers.push_back(nullptr);
            continue;
        }
        Reply reply = decodeImage(image.at("request"), file->fd());
        if (reply.header == protocol::kHandOn) {
            answers.push_back(nullptr);
            continue;
        }
        total += reply.payload.bytes().size();
        answers.push_back({{"header", reply.header}, {"size", reply.payload.bytes().size()}});
        pixels.push_back(std::move(reply.payload));
    }
    Reply reply;
    reply.header = toJsonText({{"images", std::move(answers)}});
    reply.payload = allocate(total);
    std::span<std::byte> target = reply.payload.writable();
    for (const MemoryFile& one : pixels) {
        std::ranges::copy(one.bytes(), target.begin());
        target = target.subspan(one.bytes().size());
    }
    return reply;
}

Reply encodeImage(const json& request, std::span<const std::byte> payload) {
    if (request.at("format") == "hdr")
        return encodeRadiance(request, payload);
    if (request.at("format") == "openexr")
        return encodeExr(request, payload);
    throw Refusal("this image format cannot be written", request.at("format").get<std::string>());
}

} // namespace patina::codec

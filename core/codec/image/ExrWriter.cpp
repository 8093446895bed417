#include "core/codec/image/ExrWriter.h"

#include "core/codec/image/PictureReader.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/stat.h>
#include <thread>

namespace patina::codec {

namespace {

using nlohmann::json;

struct Part {
    Imf::Header header;
    std::vector<std::string> channels;
    const float* pixels = nullptr;
    std::size_t width = 0, height = 0;
    bool half = false;
};

Part partOf(const json& description, std::span<const std::byte>& payload) {
    Part part;
    const int width = description.at("width");
    const int height = description.at("height");
    part.width = static_cast<std::size_t>(width);
    part.height = static_cast<std::size_t>(height);
    part.channels = description.at("channelNames").get<std::vector<std::string>>();
    part.half = description.at("half");
    const std::size_t size = part.width * part.height * part.channels.size() * sizeof(float);
    if (width <= 0 || height <= 0 || description.at("type") != "f32" ||
        description.at("channels") != part.channels.size() || size > payload.size())
        throw Refusal("the image cannot be encoded", "pixels are missing");
    part.pixels = reinterpret_cast<const float*>(payload.data());
    payload = payload.subspan(std::min(payload.size(), (size + 15) / 16 * 16));

    part.header = Imf::Header(width, height);
    for (const std::string& name : part.channels)
        part.header.channels().insert(name, Imf::Channel(part.half ? Imf::HALF : Imf::FLOAT));
    constexpr int kLevel = 4;
    part.header.compression() = Imf::ZIP_COMPRESSION;
    part.header.zipCompressionLevel() = kLevel;
    // Or it would be the time of writing: the same picture in other bytes.
    part.header.insert("capDate", Imf::StringAttribute(""));
    if (const auto name = description.at("name").get<std::string>(); !name.empty())
        part.header.insert("name", Imf::StringAttribute(name));
    for (const auto& [key, value] : description.at("attributes").items())
        part.header.insert(key, Imf::StringAttribute(value.get<std::string>()));
    return part;
}

void shareDisplayWindow(std::vector<Part>& parts) {
    std::size_t width = 0, height = 0;
    bool differ = false;
    for (const Part& part : parts) {
        differ = differ || part.width != parts[0].width || part.height != parts[0].height;
        width = std::max(width, part.width);
        height = std::max(height, part.height);
    }
    if (!differ)
        return;
    for (Part& part : parts) {
        part.header.displayWindow().max = {static_cast<int>(width) - 1,
                                           static_cast<int>(height) - 1};
        part.header.insert(kOwnSize, Imf::StringAttribute("data window"));
    }
}

// Rows at a time, as halves where the file holds those. `Output`: a file or a part of one.
template <class Output>
void writePixels(Output& output, const Part& part) {
    constexpr std::size_t kRows = 64;
    const std::size_t row = part.width * part.channels.size();
    std::vector<Imath::half> halves(part.half ? row * kRows : 0);
    const std::size_t sample = part.half ? sizeof(Imath::half) : sizeof(float);
    for (std::size_t y = 0; y < part.height; y += kRows) {
        const std::size_t rows = std::min(kRows, part.height - y);
        const float* from = part.pixels + y * row;
        const void* data = from;
        if (part.half) {
            std::transform(from, from + rows * row, halves.begin(),
                           [](float value) { return Imath::half(value); });
            data = halves.data();
        }
        // OpenEXR wants the address that pixel (0, 0) would have; it only reads.
        const auto origin = reinterpret_cast<std::uintptr_t>(data) - y * row * sample;
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < part.channels.size(); ++c)
            frame.insert(part.channels[c], Imf::Slice(part.half ? Imf::HALF : Imf::FLOAT,
                                                      reinterpret_cast<char*>(origin + c * sample),
                                                      part.channels.size() * sample, row * sample));
        output.setFrameBuffer(frame);
        output.writePixels(static_cast<int>(rows));
    }
}

void write(const std::string& file, std::vector<Part>& parts) {
    if (parts.size() == 1) {
        Imf::OutputFile output(file.c_str(), parts[0].header);
        writePixels(output, parts[0]);
        return;
    }
    std::vector<Imf::Header> headers;
    for (Part& part : parts) {
        part.header.setType(Imf::SCANLINEIMAGE);
        headers.push_back(part.header);
    }
    Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Imf::OutputPart part(output, static_cast<int>(i));
        writePixels(part, parts[i]);
    }
}

} // namespace

Reply encodeExr(const json& request, std::span<const std::byte> payload) {
    // A few threads where they are worth being started: large bakes take seconds to compress.
    constexpr std::size_t kWorthIt = std::size_t{3} << 20;
    if (payload.size() > kWorthIt)
        Imf::setGlobalThreadCount(
            static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 4u)));
    std::vector<Part> parts;
    for (const json& description : request.at("parts"))
        parts.push_back(partOf(description, payload));
    shareDisplayWindow(parts);
    // OpenEXR opens files of several parts by name only, which here is the name of a memory file.
    FileDescriptor memory = MemoryFile::createGrowing();
    try {
        write(fmt::format("/proc/self/fd/{}", memory.get()), parts);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        throw Refusal("the image cannot be encoded", std::string("openexr: ") + exception.what());
    }
    struct stat status {};
    if (::fstat(memory.get(), &status) != 0)
        throw std::bad_alloc();
    auto file =
        MemoryFile::open(std::move(memory), static_cast<std::size_t>(status.st_size), false);
    if (!file)
        throw std::bad_alloc();
    Reply reply;
    reply.header = "{}";
    reply.payload = std::move(*file);
    return reply;
}

} // namespace patina::codec

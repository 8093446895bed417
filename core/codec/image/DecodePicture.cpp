#include "core/codec/image/DecodePicture.h"

#include "core/base/Limits.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

namespace patina::codec {

namespace {

using nlohmann::json;

// The picture as it is to be shown: the display window where it differs from the data window.
struct Frame {
    int width = 0, height = 0;
    int left = 0, top = 0; // of the data window inside the frame
    bool cropped = false;
};

Frame frameOf(const PictureSpec& spec) {
    Frame frame{spec.width, spec.height, 0, 0, false};
    if (spec.hasOwnSize)
        return frame;
    if (spec.fullWidth > 0 && spec.fullHeight > 0 &&
        (spec.fullWidth != spec.width || spec.fullHeight != spec.height || spec.fullX != spec.x ||
         spec.fullY != spec.y)) {
        frame.width = spec.fullWidth;
        frame.height = spec.fullHeight;
        const auto offset = [](long long a, long long b) {
            return static_cast<int>(std::clamp<long long>(a - b, INT32_MIN, INT32_MAX));
        };
        frame.left = offset(spec.x, spec.fullX);
        frame.top = offset(spec.y, spec.fullY);
        frame.cropped = true;
    }
    return frame;
}

// libjpeg fills what a cut-off file lacks with grey and calls it a warning; the end marker tells.
void requireJpegEnd(int fd) {
    struct stat status {};
    if (::fstat(fd, &status) != 0)
        return;
    constexpr off_t kTail = 1 << 16; // cameras append a little
    std::array<unsigned char, kTail> tail{};
    const off_t begin = std::max<off_t>(0, status.st_size - kTail);
    const ssize_t size = ::pread(fd, tail.data(), tail.size(), begin);
    for (ssize_t i = size - 2; i >= 0; --i)
        if (tail[static_cast<std::size_t>(i)] == 0xff &&
            tail[static_cast<std::size_t>(i) + 1] == 0xd9)
            return;
    throw Refusal("the file is damaged or cut short; save or download it again",
                  "jpeg: no end-of-image marker");
}

struct PartLayout {
    int index = 0;
    PictureSpec spec;
    Frame frame;
    Channels channels; // what is wanted of it
    ImageSize target;  // the frame's, or smaller
    std::size_t offset = 0, size = 0;

    [[nodiscard]] bool reduced() const { return target != ImageSize{frame.width, frame.height}; }
    [[nodiscard]] std::size_t pixelSize() const {
        return static_cast<std::size_t>(channels.count) * sizeOf(spec.kind);
    }
};

json describe(const PartLayout& part) {
    const auto names = part.spec.channelNames.begin() + part.channels.first;
    return {{"name", part.spec.name},
            {"width", part.target.width},
            {"height", part.target.height},
            {"channels", part.channels.count},
            {"channelNames", std::vector<std::string>(names, names + part.channels.count)},
            {"stored", part.spec.stored},
            {"attributes", part.spec.attributes},
            {"type", nameOf(part.spec.kind)},
            {"offset", part.offset}};
}

// Red, green and blue of a part, or its luminance: "R" "G" "B", also inside a layer
// ("beauty.R"), or "Y". Unnamed channels of other formats are colours from the first on.
bool selectColor(PartLayout& part, bool named) {
    if (!named) {
        part.channels.count = std::min(part.channels.count, part.channels.count < 3 ? 1 : 3);
        return true;
    }
    const std::vector<std::string>& names = part.spec.channelNames;
    const auto select = [&](std::initializer_list<const char*> wanted) {
        const std::size_t count = wanted.size();
        for (std::size_t i = 0; i + count <= names.size(); ++i) {
            const std::string layer = names[i].substr(0, names[i].rfind('.') + 1);
            if (std::equal(wanted.begin(), wanted.end(), names.begin() + static_cast<int>(i),
                           [&](const char* letter, const std::string& name) {
                               return name == layer + letter;
                           })) {
                part.channels = {static_cast<int>(i), static_cast<int>(count)};
                return true;
            }
        }
        return false;
    };
    const bool chroma = std::find(names.begin(), names.end(), "RY") != names.end();
    return select({"R", "G", "B"}) || (!chroma && select({"Y"})); // Y alone would lose the colours
}

// Averages the picture down while it is read, a few rows at a time.
void readReduced(PictureReader& reader, const PartLayout& part, std::span<std::byte> target) {
    const PictureSpec& spec = part.spec;
    const int rows = spec.tileHeight > 0 ? spec.tileHeight : 64;
    const auto row =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(part.channels.count);
    std::vector<float> samples(row * static_cast<std::size_t>(rows));
    RowReducer reducer(spec.width, spec.height, part.target.width, part.target.height,
                       part.channels.count);
    for (int y = 0; y < spec.height; y += rows) {
        const int end = std::min(y + rows, spec.height);
        reader.readRows(part.index, part.channels, y, end, samples);
        for (int i = 0; i < end - y; ++i)
            reducer.addRow(std::span(samples).subspan(static_cast<std::size_t>(i) * row, row));
    }
    std::memcpy(target.data(), reducer.result().data(), reducer.result().size_bytes());
}

void readPart(PictureReader& reader, const PartLayout& part, std::span<std::byte> target) {
    if (part.reduced())
        return readReduced(reader, part, target);
    if (!part.frame.cropped) {
        reader.read(part.index, part.channels, target);
        return;
    }
    const PictureSpec& spec = part.spec;
    const std::size_t pixelSize = part.pixelSize();
    checkImageSize(spec.width, spec.height, part.channels.count, sizeOf(spec.kind));
    std::vector<std::byte> data(static_cast<std::size_t>(spec.width) *
                                static_cast<std::size_t>(spec.height) * pixelSize);
    reader.read(part.index, part.channels, data);
    const long long left = std::max(0, part.frame.left);
    const long long right =
        std::min<long long>(part.frame.width, static_cast<long long>(part.frame.left) + spec.width);
    for (int y = 0; y < part.frame.height; ++y) {
        const long long sourceY = static_cast<long long>(y) - part.frame.top;
        if (sourceY < 0 || sourceY >= spec.height || left >= right)
            continue;
        const auto from = static_cast<std::size_t>(sourceY * spec.width + left - part.frame.left);
        const auto to =
            static_cast<std::size_t>(static_cast<long long>(y) * part.frame.width + left);
        std::memcpy(target.data() + to * pixelSize, data.data() + from * pixelSize,
                    static_cast<std::size_t>(right - left) * pixelSize);
    }
}

} // namespace

const char* nameOf(SampleKind kind) {
    return kind == SampleKind::U8 ? "u8" : kind == SampleKind::U16 ? "u16" : "f32";
}

bool isStorage(std::string_view attribute) {
    constexpr std::array<std::string_view, 7> kNames{
        "name", "compression", "textureformat", "wrapmodes", "ICCProfile", "DateTime", kOwnSize};
    return attribute.starts_with("oiio:") || attribute.starts_with("openexr:") ||
           std::find(kNames.begin(), kNames.end(), attribute) != kNames.end();
}

std::string joined(std::span<const float> values) {
    return fmt::format("{}", fmt::join(values, " "));
}

std::string libraryText(const std::string& format, std::string error) {
    constexpr std::size_t kLongest = 300;
    error.resize(std::min({error.size(), error.find('\n'), kLongest}));
    return error.empty() ? format : format + ": " + error;
}

Reply decodePicture(PictureReader& reader, const json& request, int payloadFd) {
    const auto format = request.at("format").get<std::string>();
    const bool inspect = request.value("inspect", false);
    const bool allParts = inspect || (request.value("allParts", false) && format == "openexr");
    const bool colorOnly = request.value("colorOnly", false) && !inspect;
    const int maxSide = inspect ? 0 : request.value("maxSide", 0);

    // Sizes first, of all parts, before anything is allocated.
    std::vector<PartLayout> parts;
    std::size_t total = 0;
    json descriptions = json::array();
    std::string skipped; // parts without colour
    for (int index = 0; index == 0 || allParts || (colorOnly && parts.empty()); ++index) {
        const PictureSpec* spec = reader.part(index);
        if (spec == nullptr)
            break;
        if (index >= limits::kMaxImageParts)
            throw Refusal(fmt::format("the file has more than {} parts", limits::kMaxImageParts));
        PartLayout part;
        part.index = index;
        part.spec = *spec;
        if (!inspect) // what only `patina info` shows; taken apart by OpenImageIO alone
            std::erase_if(part.spec.attributes,
                          [](const auto& entry) { return entry.first.starts_with("ICCProfile:"); });
        part.frame = frameOf(part.spec);
        part.channels = {0, part.spec.channels()};
        if (colorOnly && !selectColor(part, format == "openexr")) {
            skipped += fmt::format("{}{}", skipped.empty() ? "" : ", ",
                                   fmt::join(part.spec.channelNames, " "));
            continue;
        }
        const int channels = part.channels.count;
        const std::size_t sampleSize = sizeOf(part.spec.kind);
        part.target = {part.frame.width, part.frame.height};
        if (part.spec.kind == SampleKind::F32 && !part.frame.cropped) {
            checkImageSize(part.frame.width, part.frame.height, 1, 1);
            part.target = reducedSize(part.target, maxSide);
        } else {
            checkImageSize(part.spec.width, part.spec.height, channels, sampleSize);
        }
        checkImageSize(part.target.width, part.target.height, channels, sampleSize);
        part.offset = total;
        part.size = static_cast<std::size_t>(part.target.width) *
                    static_cast<std::size_t>(part.target.height) * part.pixelSize();
        if (!inspect) {
            total += (part.size + 15) / 16 * 16;
            if (total > limits::kMaxImageBytes)
                throw Refusal("the parts of the file together need too much memory");
        }
        descriptions.push_back(describe(part));
        parts.push_back(std::move(part));
    }
    if (parts.empty() && !skipped.empty())
        throw Refusal(fmt::format("the file holds no colours: it has the channels {} instead of R, "
                                  "G, B or Y; save its colours",
                                  skipped.substr(0, 200)));
    if (parts.empty())
        throw Refusal("the file holds no image", libraryText(format, reader.problem()));

    Reply reply;
    reply.header = toJsonText({{"format", format}, {"parts", descriptions}});
    reply.payload = allocate(total);
    if (inspect)
        return reply;
    for (const PartLayout& part : parts)
        readPart(reader, part, reply.payload.writable().subspan(part.offset, part.size));
    if (format == "jpeg")
        requireJpegEnd(payloadFd);
    return reply;
}

} // namespace patina::codec

#include "core/bake/file/BakeChannels.h"

#include "core/bake/file/BakeSource.h"
#include "core/bake/lightmap/LightMap.h"
#include "core/base/Check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace patina {
namespace {

constexpr const char* kBouncedPrefix = "bounced.";
constexpr std::array<const char*, 3> kColors = {".R", ".G", ".B"};

// By Cauchy-Schwarz |T_i| is at most sqrt(2/3/pi) = 0.46; a least-squares fit overshoots a little.
// What bounces may add up where all albedos are 1. Far beyond both only damage lies.
constexpr float kMaxDirect = 100.0f, kMaxBounced = 10'000.0f;

// "l0m0", "l1m-1" …
std::vector<std::string> coefficientNames(int order) {
    std::vector<std::string> names;
    for (int l = 0; l < order; ++l)
        for (int m = -l; m <= l; ++m)
            names.push_back(fmt::format("l{}m{}", l, m));
    return names;
}

// Of the values of an element, in their order.
std::vector<std::string> valueNames(BakeKind kind, int order) {
    std::vector<std::string> names;
    if (holdsTransfer(kind)) {
        for (const std::string& name : coefficientNames(order))
            names.push_back("sh." + name);
    } else if (kind == BakeKind::LightMap) {
        // Those of core/bake/lightmap/LightMap.h.
        for (const char* color : kColors)
            names.push_back(std::string("irradiance") + color);
        names.emplace_back("visibility");
        for (const std::string& name : coefficientNames(kLightMapOrder)) {
            for (const char* color : kColors)
                names.push_back("radiance." + name + color);
            names.push_back("hidden." + name);
        }
        for (const char* axis : {".X", ".Y", ".Z"})
            names.push_back(std::string("open") + axis);
    } else {
        names.emplace_back("ao");
    }
    return names;
}

bool grey(std::span<const float> rgb) {
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
        if (rgb[i] != rgb[i + 1] || rgb[i] != rgb[i + 2])
            return false;
    return true;
}

// `values` interleaved with `stride`, into the image's channels from `first` on.
void store(Image& image, std::size_t first, std::span<const float> values, std::size_t stride) {
    const auto channels = static_cast<std::size_t>(image.channels());
    const std::span<float> pixels = image.f32();
    for (std::size_t element = 0; element * stride < values.size(); ++element)
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(element * stride), stride,
                    pixels.begin() + static_cast<std::ptrdiff_t>(element * channels + first));
}

class ChannelReader {
  public:
    ChannelReader(const Image& image, std::size_t count)
        : m_image(image)
        , m_count(count) {}

    [[nodiscard]] bool has(const std::string& name) const { return indexOf(name).has_value(); }

    // The channel becomes every stride-th number of `values`, from `offset` on.
    bool read(const std::string& name, std::vector<float>& values, std::size_t offset,
              std::size_t stride) {
        const std::optional<std::size_t> channel = indexOf(name);
        if (!channel)
            return false;
        ++m_used;
        values.resize(m_count * stride);
        const auto channels = static_cast<std::size_t>(m_image.channels());
        for (std::size_t i = 0; i < m_count; ++i)
            values[i * stride + offset] = m_image.f32()[i * channels + *channel];
        return true;
    }
    void readIfThere(const std::string& name, std::vector<float>& values) {
        if (has(name))
            read(name, values, 0, 1);
    }
    [[nodiscard]] bool usedAll() const {
        const std::vector<std::string>& names = m_image.channelNames();
        return m_used + static_cast<std::size_t>(
                            std::count_if(names.begin(), names.end(), isSourceChannel)) ==
               names.size();
    }

  private:
    [[nodiscard]] std::optional<std::size_t> indexOf(const std::string& name) const {
        const std::vector<std::string>& names = m_image.channelNames();
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            return std::nullopt;
        return static_cast<std::size_t>(found - names.begin());
    }

    const Image& m_image;
    std::size_t m_count, m_used = 0;
};

bool within(std::span<const float> values, float low, float high) {
    return std::all_of(values.begin(), values.end(), // false for what is not a number
                       [=](float value) { return value >= low && value <= high; });
}

} // namespace

BakeImage imageFromElements(const BakeElementsView& elements, BakeKind kind, int order,
                            std::size_t width, const BakeFileOptions& options) {
    const auto stride = static_cast<std::size_t>(elements.stride);
    const std::size_t count = elements.values.size() / stride;
    std::vector<std::string> names = valueNames(kind, order);
    CHECK_EQ(names.size(), stride);

    // Grey light by way of other surfaces needs a third of the place.
    std::vector<float> bounced(elements.bounced.begin(), elements.bounced.end());
    const bool mono = grey(bounced);
    if (mono)
        for (std::size_t i = 0; 3 * i < bounced.size(); ++i)
            bounced[i] = bounced[3 * i];
    const std::size_t colors = mono ? 1 : 3;
    bounced.resize(elements.bounced.size() / 3 * colors);
    if (!bounced.empty())
        for (const std::string& name : coefficientNames(order))
            for (std::size_t c = 0; c < colors; ++c)
                names.push_back(kBouncedPrefix + name + (mono ? "" : kColors[c]));
    if (!elements.sky.empty())
        names.emplace_back("sky");
    if (!elements.error.empty())
        names.emplace_back("error");

    BakeImage result;
    std::vector<float> values(elements.values.begin(), elements.values.end());
    if (options.storage == BakeStorage::Quantised) {
        result.steps.values = bandSteps(values, order, 1, options.bits);
        quantise(values, order, 1, result.steps.values);
        result.steps.bounced = bandSteps(bounced, order, static_cast<int>(colors), options.bits);
        quantise(bounced, order, static_cast<int>(colors), result.steps.bounced);
    }
    result.image = Image(static_cast<int>(width), static_cast<int>((count + width - 1) / width),
                         static_cast<int>(names.size()), PixelType::F32, ColorEncoding::Linear);
    std::size_t next = 0;
    const auto add = [&](std::span<const float> numbers, std::size_t perElement) {
        if (numbers.empty())
            return;
        store(result.image, next, numbers, perElement);
        next += perElement;
    };
    add(values, stride);
    add(bounced, colors * stride);
    add(elements.sky, 1);
    add(elements.error, 1);
    if (options.storage != BakeStorage::Float) // whole numbers are exact in halves
        for (float& value : result.image.f32())
            value = roundedToHalf(value);
    result.image.setChannelNames(std::move(names));
    return result;
}

std::optional<BakeElements> elementsFromImage(const Image& image, BakeKind kind, int order,
                                              std::size_t count, const BakeSteps& steps) {
    const auto pixels =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    if (image.type() != PixelType::F32 || pixels < count ||
        image.channelNames().size() != static_cast<std::size_t>(image.channels()))
        return std::nullopt;
    BakeElements elements;
    ChannelReader reader(image, count);
    const std::vector<std::string> held = valueNames(kind, order);
    const std::size_t stride = held.size();
    elements.stride = static_cast<int>(stride);
    for (std::size_t i = 0; i < held.size(); ++i)
        if (!reader.read(held[i], elements.values, i, stride))
            return std::nullopt;
    if (const std::vector<std::string> names = coefficientNames(order); hasBounced(image)) {
        if (names.empty())
            return std::nullopt;
        const bool mono = reader.has(kBouncedPrefix + names[0]);
        for (std::size_t i = 0; i < names.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::string name = kBouncedPrefix + names[i] + (mono ? "" : kColors[c]);
                if (mono && c > 0) {
                    for (std::size_t e = 0; e < count; ++e)
                        elements.bounced[3 * (e * stride + i) + c] =
                            elements.bounced[3 * (e * stride + i)];
                } else if (!reader.read(name, elements.bounced, 3 * i + c, 3 * stride)) {
                    return std::nullopt;
                }
            }
    }
    if (order > 0) {
        reader.readIfThere("sky", elements.sky);
        reader.readIfThere("error", elements.error);
    }
    if (!reader.usedAll())
        return std::nullopt;
    if (!steps.values.empty())
        dequantise(elements.values, order, 1, steps.values);
    if (!steps.bounced.empty())
        dequantise(elements.bounced, order, 3, steps.bounced);
    return elements;
}

bool hasBounced(const Image& image) {
    const std::vector<std::string>& names = image.channelNames();
    return std::any_of(names.begin(), names.end(),
                       [](const std::string& name) { return name.starts_with(kBouncedPrefix); });
}

bool plausible(const BakeElements& elements, BakeKind kind) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    if (kind == BakeKind::LightMap)
        return within(elements.values, -kLargest, kLargest);
    const bool transfer = holdsTransfer(kind);
    const float low = transfer ? -kMaxDirect : 0.0f, high = transfer ? kMaxDirect : 1.0f;
    return within(elements.values, low, high) &&
           within(elements.bounced, -kMaxBounced, kMaxBounced) &&
           within(elements.sky, 0.0f, 1.0f) && within(elements.error, 0.0f, kLargest);
}

} // namespace patina

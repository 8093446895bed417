#include "core/codec/model/GltfBuffers.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/model/MeshoptViews.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>

namespace patina::codec {

namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& detail) {
    throw Refusal("the file is damaged or cut short; export or download it again", detail);
}

struct ComponentType {
    std::size_t size;
    double maximum; // of a normalised integer
};

ComponentType componentType(int code) {
    switch (code) {
    case 5120:
        return {1, 127.0};
    case 5121:
        return {1, 255.0};
    case 5122:
        return {2, 32767.0};
    case 5123:
        return {2, 65535.0};
    case 5125:
        return {4, 4294967295.0};
    case 5126:
        return {4, 1.0};
    default:
        refuse(fmt::format("component type {}", code));
    }
}

template <class T>
double load(const std::byte* data) {
    T value;
    std::memcpy(&value, data, sizeof value);
    return static_cast<double>(value);
}

double loadComponent(const std::byte* data, int code) {
    switch (code) {
    case 5120:
        return load<std::int8_t>(data);
    case 5121:
        return load<std::uint8_t>(data);
    case 5122:
        return load<std::int16_t>(data);
    case 5123:
        return load<std::uint16_t>(data);
    case 5125:
        return load<std::uint32_t>(data);
    default:
        return load<float>(data);
    }
}

int componentsOf(const std::string& type) {
    if (type == "SCALAR")
        return 1;
    if (type == "VEC2")
        return 2;
    if (type == "VEC3")
        return 3;
    if (type == "VEC4")
        return 4;
    if (type == "MAT4")
        return 16;
    refuse("accessor type " + type);
}

// The bytes of `count` elements of `size` bytes, `stride` apart.
struct Elements {
    const std::byte* data = nullptr; // null: all zero
    std::size_t count = 0;
    std::size_t stride = 0;
};

Elements elements(std::span<const std::byte> bytes, std::size_t offset, std::size_t count,
                  std::size_t size, std::size_t stride) {
    if (stride < size)
        refuse("byte stride");
    const std::size_t available = offset > bytes.size() ? 0 : bytes.size() - offset;
    if (count > 0 && (available < size || (available - size) / stride + 1 < count))
        refuse("an accessor reaches beyond its buffer");
    return {bytes.data() + std::min(offset, bytes.size()), count, stride};
}

} // namespace

const json& element(const json& root, const char* array, std::size_t index) {
    const auto it = root.find(array);
    if (it == root.end() || !it->is_array() || index >= it->size())
        refuse(fmt::format("{}[{}] does not exist", array, index));
    return (*it)[index];
}

bool decodeDataUri(const std::string& uri, std::vector<std::byte>& bytes) {
    const std::size_t comma = uri.find(',');
    if (!uri.starts_with("data:") || comma == std::string::npos)
        return false;
    if (uri.substr(0, comma).find(";base64") == std::string::npos) {
        const std::string text = decodePercent(uri.substr(comma + 1));
        bytes.resize(text.size());
        std::memcpy(bytes.data(), text.data(), text.size());
        return true;
    }
    static constexpr std::string_view kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value{};
    value.fill(-1);
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
        value[static_cast<unsigned char>(kAlphabet[i])] = static_cast<int>(i);
    bytes.reserve((uri.size() - comma) / 4 * 3);
    std::uint32_t bits = 0;
    int filled = 0;
    for (std::size_t i = comma + 1; i < uri.size() && uri[i] != '='; ++i) {
        const int digit = value[static_cast<unsigned char>(uri[i])];
        if (digit < 0)
            continue; // white space
        bits = (bits << 6) | static_cast<std::uint32_t>(digit);
        filled += 6;
        if (filled >= 8) {
            filled -= 8;
            bytes.push_back(static_cast<std::byte>((bits >> filled) & 0xff));
        }
    }
    return true;
}

GltfBuffers::GltfBuffers(const json& root, std::span<const std::byte> binary,
                         const ModelFolder& folder)
    : m_root(root) {
    const auto buffers = root.find("buffers");
    if (buffers == root.end())
        return;
    for (const json& buffer : *buffers) {
        const auto uri = buffer.find("uri");
        if (uri == buffer.end()) {
            m_buffers.push_back(m_buffers.empty() ? binary : std::span<const std::byte>());
            continue;
        }
        const auto text = uri->get<std::string>();
        std::vector<std::byte> decoded;
        if (decodeDataUri(text, decoded)) {
            m_inline.push_back(std::move(decoded));
            m_buffers.emplace_back(m_inline.back());
            continue;
        }
        auto file = folder.open(decodePercent(text));
        if (!file)
            throw Refusal(fmt::format("the file needs \"{}\" beside it, which is missing; copy "
                                      "it into the same folder",
                                      decodePercent(text)));
        m_buffers.push_back(file->bytes());
        m_files.push_back(std::move(*file));
    }
}

std::span<const std::byte> GltfBuffers::view(std::size_t index) const {
    const json& view = element(m_root, "bufferViews", index);
    const json* compressed = meshoptOf(view);
    if (compressed == nullptr)
        return bytesOf(view);
    auto known = m_uncompressed.find(index);
    if (known == m_uncompressed.end())
        known =
            m_uncompressed.emplace(index, decodeMeshopt(*compressed, bytesOf(*compressed))).first;
    return known->second;
}

std::span<const std::byte> GltfBuffers::bytesOf(const json& place) const {
    const auto buffer = place.at("buffer").get<std::size_t>();
    const auto offset = place.value("byteOffset", std::size_t{0});
    const auto length = place.at("byteLength").get<std::size_t>();
    if (buffer >= m_buffers.size())
        refuse("a buffer view without a buffer");
    const auto bytes = m_buffers[buffer];
    if (offset > bytes.size() || length > bytes.size() - offset)
        refuse("a buffer view reaches beyond its buffer");
    return bytes.subspan(offset, length);
}

// An accessor without a view is all zeros (sparse ones build on that): some words of JSON would
// stand for gigabytes. Real files have none, or a few small ones.
void GltfBuffers::takeZeros(std::size_t count) const {
    constexpr std::size_t kMostZeros = 1'000'000;
    m_zeros += std::min(count, kMostZeros + 1);
    if (m_zeros > kMostZeros)
        throw Refusal("the file announces more geometry than it holds; it is damaged",
                      fmt::format("more than {} elements without bytes", kMostZeros));
}

std::size_t GltfBuffers::count(std::size_t accessor) const {
    const auto count = element(m_root, "accessors", accessor).at("count").get<std::size_t>();
    if (count > 3 * limits::kMaxTriangles)
        throw Refusal("the model is larger than the supported 50 million triangles");
    return count;
}

std::span<const float> GltfBuffers::floatsInPlace(std::size_t index, int components) const {
    const json& accessor = element(m_root, "accessors", index);
    const auto viewIndex = accessor.find("bufferView");
    if (viewIndex == accessor.end() || accessor.contains("sparse") ||
        accessor.at("componentType") != 5126 ||
        componentsOf(accessor.at("type").get<std::string>()) != components)
        return {};
    const std::size_t n = count(index);
    const std::size_t size = static_cast<std::size_t>(components) * sizeof(float);
    const auto view = viewIndex->get<std::size_t>();
    if (element(m_root, "bufferViews", view).value("byteStride", size) != size)
        return {};
    const Elements source =
        elements(this->view(view), accessor.value("byteOffset", std::size_t{0}), n, size, size);
    if (reinterpret_cast<std::uintptr_t>(source.data) % alignof(float) != 0)
        return {};
    return {reinterpret_cast<const float*>(source.data), n * static_cast<std::size_t>(components)};
}

std::vector<float> GltfBuffers::floats(std::size_t index, int components) const {
    return read(index, components, true);
}

std::vector<float> GltfBuffers::displacements(std::size_t index) const {
    return read(index, 3, false);
}

std::vector<float> GltfBuffers::matrices(std::size_t index) const {
    const json& accessor = element(m_root, "accessors", index);
    if (accessor.at("type") != "MAT4" || accessor.at("componentType") != 5126)
        refuse("an accessor of matrices holds none");
    return floats(index, 16);
}

std::vector<float> GltfBuffers::read(std::size_t index, int components, bool countZeros) const {
    const json& accessor = element(m_root, "accessors", index);
    const int code = accessor.at("componentType");
    const ComponentType type = componentType(code);
    const bool normalized = accessor.value("normalized", false);
    const std::size_t n = count(index);
    const auto stored =
        static_cast<std::size_t>(componentsOf(accessor.at("type").get<std::string>()));
    const auto wanted = static_cast<std::size_t>(components);
    const std::size_t size = stored * type.size;
    // Checked before memory is taken. Without a view all elements are zero.
    Elements source;
    if (const auto viewIndex = accessor.find("bufferView"); viewIndex != accessor.end()) {
        const auto stride =
            element(m_root, "bufferViews", viewIndex->get<std::size_t>()).value("byteStride", size);
        source = elements(view(viewIndex->get<std::size_t>()),
                          accessor.value("byteOffset", std::size_t{0}), n, size, stride);
    } else if (countZeros) {
        takeZeros(n);
    }
    std::vector<float> result(n * wanted, 0.0f);

    const auto copyElement = [&](const std::byte* from, std::size_t to) {
        for (std::size_t c = 0; c < std::min(stored, wanted); ++c) {
            double value = loadComponent(from + c * type.size, code);
            if (normalized && code != 5126)
                value = std::max(value / type.maximum, -1.0);
            result[to * wanted + c] = static_cast<float>(value);
        }
    };
    for (std::size_t i = 0; source.data != nullptr && i < n; ++i)
        copyElement(source.data + i * source.stride, i);

    // A sparse accessor replaces some elements.
    if (const auto sparse = accessor.find("sparse"); sparse != accessor.end()) {
        const auto changed = sparse->at("count").get<std::size_t>();
        const json& where = sparse->at("indices");
        const json& what = sparse->at("values");
        const int whereCode = where.at("componentType");
        const std::size_t whereSize = componentType(whereCode).size;
        const Elements targets =
            elements(view(where.at("bufferView").get<std::size_t>()),
                     where.value("byteOffset", std::size_t{0}), changed, whereSize, whereSize);
        const Elements values =
            elements(view(what.at("bufferView").get<std::size_t>()),
                     what.value("byteOffset", std::size_t{0}), changed, size, size);
        for (std::size_t i = 0; i < changed; ++i) {
            const double target = loadComponent(targets.data + i * whereSize, whereCode);
            if (!(target >= 0.0 && target < static_cast<double>(n)))
                refuse("a sparse index is out of range");
            copyElement(values.data + i * size, static_cast<std::size_t>(target));
        }
    }
    return result;
}

std::vector<std::uint32_t> GltfBuffers::indices(std::size_t index) const {
    const json& accessor = element(m_root, "accessors", index);
    const int code = accessor.at("componentType");
    if (code != 5121 && code != 5123 && code != 5125)
        refuse("indices are no unsigned integers");
    const std::size_t size = componentType(code).size;
    const std::size_t n = count(index);
    const auto viewIndex = accessor.find("bufferView");
    if (viewIndex == accessor.end()) {
        takeZeros(n);
        return std::vector<std::uint32_t>(n, 0);
    }
    const Elements source = elements(view(viewIndex->get<std::size_t>()),
                                     accessor.value("byteOffset", std::size_t{0}), n, size, size);
    if (code == 5125 && reinterpret_cast<std::uintptr_t>(source.data) % size == 0) {
        const auto* const first = reinterpret_cast<const std::uint32_t*>(source.data);
        return {first, first + n};
    }
    std::vector<std::uint32_t> result(n);
    for (std::size_t i = 0; i < n; ++i)
        result[i] = static_cast<std::uint32_t>(loadComponent(source.data + i * size, code));
    return result;
}

} // namespace patina::codec

#include "core/bake/document/BakeCache.h"

#include "core/bake/Bake.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/base/ById.h"
#include "core/material/Material.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace patina {
namespace {

// Changes whenever a bake would come to something else, or the files are laid out otherwise.
constexpr std::uint32_t kAlgorithm = 3;
constexpr std::size_t kMaxFile = std::size_t{16} << 30;

// Meshes by their position among the inputs, materials by that of the first mesh that has them.
std::optional<std::uint32_t> positionOf(const BakeInputs& inputs, const BakeMesh* mesh) {
    if (mesh == nullptr)
        return std::nullopt;
    return static_cast<std::uint32_t>(mesh - inputs.meshes.data());
}

class Writer {
  public:
    template <class T>
    void value(const T& v) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&v, sizeof(v));
    }
    void text(std::string_view v) {
        value(static_cast<std::uint64_t>(v.size()));
        append(v.data(), v.size());
    }
    void floats(std::span<const float> v) {
        value(static_cast<std::uint64_t>(v.size()));
        append(v.data(), v.size_bytes());
    }
    [[nodiscard]] Bytes take() { return std::move(m_bytes); }

  private:
    void append(const void* data, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(data);
        m_bytes.insert(m_bytes.end(), first, first + size);
    }
    Bytes m_bytes;
};

// Reads what a Writer wrote; ok() turns false where the bytes end early.
class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes)
        : m_left(bytes) {}
    template <class T>
    T value() {
        T result{};
        take(&result, sizeof(T));
        return result;
    }
    std::string text() {
        std::string result(count(1), '\0');
        take(result.data(), result.size());
        return result;
    }
    std::vector<float> floats() {
        std::vector<float> result(count(sizeof(float)));
        take(result.data(), result.size() * sizeof(float));
        return result;
    }
    [[nodiscard]] bool ok() const { return m_ok; }
    [[nodiscard]] bool atEnd() const { return m_ok && m_left.empty(); }

  private:
    std::size_t count(std::size_t size) {
        const auto wanted = value<std::uint64_t>();
        if (wanted > m_left.size() / size)
            m_ok = false;
        return m_ok ? static_cast<std::size_t>(wanted) : 0;
    }
    void take(void* to, std::size_t size) {
        m_ok = m_ok && size <= m_left.size();
        if (!m_ok || size == 0)
            return;
        std::memcpy(to, m_left.data(), size);
        m_left = m_left.subspan(size);
    }
    std::span<const std::byte> m_left;
    bool m_ok = true;
};

std::optional<Bytes> encode(const BakeInputs& inputs, const BakeArtifact& artifact) {
    Writer out;
    out.value(artifact.kind);
    out.value(artifact.inputs);
    out.value(artifact.albedo);
    const auto record = recordOf(artifact);
    out.value(static_cast<std::uint32_t>(record.size()));
    for (const auto& [name, text] : record) {
        out.text(name);
        out.text(text);
    }
    out.value(artifact.order);
    out.value(artifact.transfer);
    out.value(artifact.bounces);
    out.value(artifact.samplesDone);
    out.value(static_cast<std::uint32_t>(artifact.vertices.size()));
    const ById meshes(inputs.meshes, &BakeMesh::id), materials(inputs.meshes, &BakeMesh::material);
    for (const VertexBake& bake : artifact.vertices) {
        const auto place = positionOf(inputs, meshes.find(bake.mesh));
        if (!place)
            return std::nullopt;
        out.value(*place);
        out.value(bake.stride);
        for (const auto* values : {&bake.values, &bake.bounced, &bake.sky, &bake.error})
            out.floats(*values);
    }
    out.value(static_cast<std::uint32_t>(artifact.texels.size()));
    for (const TexelBake& bake : artifact.texels) {
        const auto place = positionOf(inputs, materials.find(bake.material));
        if (!place)
            return std::nullopt;
        out.value(*place);
        out.value(bake.side);
        out.value(bake.stride);
        for (const auto* values : {&bake.values, &bake.bounced, &bake.sky, &bake.error})
            out.floats(*values);
        out.value(bake.image ? bake.image->width() : 0);
        if (bake.image)
            out.floats(std::as_const(*bake.image).f32());
    }
    return out.take();
}

std::optional<BakeArtifact> decode(const Bytes& bytes, const BakeInputs& inputs) {
    Reader in(bytes);
    BakeArtifact artifact;
    artifact.kind = in.value<BakeKind>();
    artifact.inputs = in.value<Hash>();
    artifact.albedo = in.value<Hash>();
    std::map<std::string, std::string> record;
    for (auto n = in.value<std::uint32_t>(); n > 0 && in.ok(); --n) {
        std::string name = in.text();
        record[std::move(name)] = in.text();
    }
    setRecord(artifact, std::move(record));
    artifact.order = in.value<int>();
    artifact.transfer = in.value<TransferKind>();
    artifact.bounces = in.value<int>();
    artifact.samplesDone = in.value<int>();
    for (auto n = in.value<std::uint32_t>(); n > 0 && in.ok(); --n) {
        const auto place = in.value<std::uint32_t>();
        if (place >= inputs.meshes.size())
            return std::nullopt;
        VertexBake& bake = artifact.vertices.emplace_back();
        bake.mesh = inputs.meshes[place].id;
        bake.stride = in.value<int>();
        for (auto* values : {&bake.values, &bake.bounced, &bake.sky, &bake.error})
            *values = in.floats();
    }
    for (auto n = in.value<std::uint32_t>(); n > 0 && in.ok(); --n) {
        const auto place = in.value<std::uint32_t>();
        if (place >= inputs.meshes.size())
            return std::nullopt;
        TexelBake& bake = artifact.texels.emplace_back();
        bake.material = inputs.meshes[place].material;
        bake.side = in.value<int>();
        bake.stride = in.value<int>();
        for (auto* values : {&bake.values, &bake.bounced, &bake.sky, &bake.error})
            *values = in.floats();
        const auto side = in.value<int>();
        if (side <= 0)
            continue;
        const std::vector<float> pixels = in.floats();
        if (pixels.size() != static_cast<std::size_t>(side) * static_cast<std::size_t>(side))
            return std::nullopt;
        auto image = std::make_shared<Image>(side, side, 1, PixelType::F32, ColorEncoding::Data);
        std::ranges::copy(pixels, image->f32().begin());
        bake.image = std::move(image);
    }
    if (!in.atEnd())
        return std::nullopt;
    return artifact;
}

} // namespace

BakeCache::BakeCache(std::filesystem::path folder, std::uint64_t maxBytes)
    : m_files(std::move(folder), ".bake", "bake", maxBytes, kMaxFile) {}

Hash BakeCache::key(const BakeRequest& request, const BakeInputs& inputs) {
    Hasher hasher;
    hasher.value(kAlgorithm).value(request.kind).value(hashBakeInputs(inputs));
    for (const auto& [name, text] : settingsText(normalized(request)))
        hasher.text(name).text(text);
    if (holdsTransfer(request.kind) && request.prt.transfer == TransferKind::Interreflected)
        hasher.value(hashBakeAlbedo(inputs));
    return hasher.finish();
}

std::optional<BakeArtifact> BakeCache::find(const Hash& key, const BakeInputs& inputs) const {
    const std::optional<Bytes> content = m_files.find(key);
    if (!content)
        return std::nullopt;
    std::optional<BakeArtifact> artifact = decode(*content, inputs);
    if (!artifact)
        m_files.drop(key);
    return artifact;
}

Result<void> BakeCache::store(const Hash& key, const BakeInputs& inputs,
                              const BakeArtifact& artifact) const {
    const std::optional<Bytes> content = encode(inputs, artifact);
    if (!content)
        return Error{ErrorKind::Internal, "The bake holds a mesh that its inputs do not.", {}, {}};
    return m_files.store(key, *content);
}

} // namespace patina

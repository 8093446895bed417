// A developer's look at the built-in library: `library_dump FOLDER` writes every map as PPM and
// every sky tone mapped, and prints how long each entry took to make.
#include "core/library/Library.h"
#include "core/material/Material.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

using namespace patina;

namespace {

void writePpm(const std::filesystem::path& file, const Image& image, bool toneMap) {
    std::ofstream out(file, std::ios::binary);
    out << "P6\n" << image.width() << ' ' << image.height() << "\n255\n";
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < 3; ++c) {
                float value = image.sample(x, y, image.channels() == 1 ? 0 : c);
                if (toneMap) // Reinhard, then about the sRGB curve
                    value = std::pow(value / (1.0f + value), 1.0f / 2.2f);
                out.put(static_cast<char>(static_cast<int>(value * 255.0f + 0.5f)));
            }
}

template <class Make>
auto timed(const std::string& name, const Make& make) {
    const auto start = std::chrono::steady_clock::now();
    auto result = make();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    fmt::print("{:<32} {:7.1f} ms\n", name, taken.count());
    return result;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: library_dump FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    timed("start scene (ball, studio)", [] {
        (void)library::model("shader-ball");
        return library::environment("studio").ok();
    });
    for (const library::Entry& entry : library::environments()) {
        const auto sky =
            timed(entry.name, [&] { return library::environment(entry.name).value(); });
        writePpm(folder / (entry.name + ".ppm"), *sky, true);
    }
    for (const library::Entry& entry : library::materials()) {
        const Material m = timed(entry.name, [&] { return library::material(entry.name).value(); });
        for (const MapSlot* slot : {&m.baseColorMap, &m.metallicMap, &m.perceptualRoughnessMap,
                                    &m.normalMap, &m.occlusionMap})
            if (slot->image) {
                std::string file = slot->source.substr(slot->source.find(':') + 1);
                file[file.find('/')] = '.';
                writePpm(folder / (file + ".ppm"), *slot->image, false);
            }
    }
    for (const library::Entry& entry : library::models()) {
        const auto parts = timed(entry.name, [&] { return library::model(entry.name).value(); });
        for (const library::ModelPart& part : parts)
            fmt::print("    {:<20} {:>7} vertices {:>7} triangles\n", part.name,
                       part.mesh->vertexCount(), part.mesh->triangleCount());
    }
    return 0;
}

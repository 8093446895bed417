// Scenes on disk: small models with textures, written by the test itself.
#pragma once

#include "core/io/ImageIO.h"
#include "core/material/Material.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace patina {

class SceneFixture : public testing::Test {
  protected:
    // One worker for all tests of a suite: starting it takes longer than most of them.
    static void SetUpTestSuite() { s_worker = std::make_unique<WorkerClient>(); }
    static void TearDownTestSuite() { s_worker.reset(); }

    // Two triangles with two materials; the second names a texture that nobody writes.
    std::string writeModel(const std::string& folder = "models") {
        m_folder.write(folder + "/pair.mtl", "newmtl Red\nKd 0.5 0.25 0.125\nmap_Kd red.png\n"
                                             "newmtl Lost\nKd 1 1 1\nmap_Kd lost.png\n"
                                             "newmtl Unused\nKd 1 1 1\n");
        writeImage(folder + "/red.png", 4, 4, {200, 10, 20});
        return m_folder
            .write(folder + "/pair.obj", "mtllib pair.mtl\n"
                                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                         "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
                                         "o First\nusemtl Red\nf 1/1/1 2/2/1 3/3/1\n"
                                         "o Second\nusemtl Lost\nf 1/1/1 3/3/1 4/2/1\n")
            .string();
    }

    std::string writeImage(const std::string& name, int width, int height,
                           const std::array<std::uint8_t, 3>& color) {
        Image image(width, height, 3, PixelType::U8, ColorEncoding::Data);
        for (std::size_t i = 0; i < image.u8().size(); ++i)
            image.u8()[i] = color[i % 3];
        return save(image, name);
    }

    std::string save(const Image& image, const std::string& name) {
        const std::filesystem::path file = m_folder / name;
        std::filesystem::create_directories(file.parent_path());
        const Result<void> saved = saveImage(m_worker, image, file);
        EXPECT_TRUE(saved.ok()) << saved.error().text();
        return file.string();
    }

    OpenedScene open(const std::string& scene) {
        Result<OpenedScene> opened = openScene(m_worker, scene);
        EXPECT_TRUE(opened.ok()) << (opened.ok() ? "" : opened.error().text());
        return opened.ok() ? *std::move(opened) : OpenedScene{};
    }

    static const Material* materialNamed(const Document& document, const std::string& name) {
        const auto found =
            std::find_if(document.materials.begin(), document.materials.end(),
                         [&](const Material& material) { return material.name == name; });
        return found == document.materials.end() ? nullptr : &*found;
    }

    static bool mentions(const std::vector<Notice>& notices, const std::string& text) {
        return std::any_of(notices.begin(), notices.end(), [&](const Notice& notice) {
            return notice.message.find(text) != std::string::npos;
        });
    }

    static inline std::unique_ptr<WorkerClient> s_worker;
    test::TemporaryFolder m_folder;
    WorkerClient& m_worker = *s_worker;
};

} // namespace patina

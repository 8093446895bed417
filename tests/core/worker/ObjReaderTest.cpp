// Our reader of OBJ files against Assimp's, which it stands in for: bakes name vertices by number.
#include "core/codec/model/ObjReader.h"
#include "core/codec/Codec.h"
#include "core/codec/model/AssimpReader.h"
#include "core/codec/model/ObjText.h"
#include "core/material/Material.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <assimp/version.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <random>

namespace patina {
namespace {

using codec::readObjText;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// A random file of a few dozen lines: numbers in many spellings, points that are equal, nearly
// equal or the two zeros, triangles and quads of any shape, parts and materials in any order.
class ObjFile {
  public:
    explicit ObjFile(unsigned seed)
        : m_random(seed)
        , m_tiny(below(3) == 0) {}

    std::string text() {
        m_text = "mtllib a.mtl\n";
        for (int i = 0; i < 4; ++i)
            position();
        for (int i = 20 + below(200); i > 0; --i)
            statement();
        return m_text;
    }

  private:
    int below(int n) { return static_cast<int>(m_random() % static_cast<unsigned>(n)); }

    std::string number() {
        if (m_tiny) // so close that Assimp may take neighbours for one point
            return fmt::format("0.{:06}", below(20));
        switch (below(8)) {
        case 0:
            return fmt::format("{}", below(5) - 2);
        case 1:
            return fmt::format("{:.17f}", below(10000) / 9973.0);
        case 2:
            return fmt::format("{:e}", (below(2000) - 1000) * 1e-7);
        case 3:
            return "-0.0";
        case 4:
            return fmt::format("+{}.5E+0{}", below(3), below(3));
        case 5:
            return fmt::format("{}.", below(9));
        default:
            return fmt::format("{:.4f}", (below(3) - 1) * 0.5);
        }
    }

    void end() { m_text += below(20) == 0 ? " \r\n" : "\n"; }

    void position() {
        m_text += fmt::format("v {}\t{}  {}", number(), number(), number());
        const int more = below(10);
        m_text += more == 0 ? " 1.5" : more == 1 ? " 0.1 0.2 0.3" : "";
        end();
        ++m_positions;
    }

    std::string index(int count) {
        const int i = below(std::min(count, 1 + below(count)));
        return std::to_string(below(6) == 0 ? i - count : i + 1);
    }

    void face() {
        const bool uvs = m_uvs > 0 && below(2) == 0, normals = m_normals > 0 && below(2) == 0;
        m_text += "f";
        for (int corner = 3 + below(2); corner > 0; --corner) {
            m_text += " " + index(m_positions);
            if (uvs || normals)
                m_text += "/" + (uvs ? index(m_uvs) : "");
            if (normals)
                m_text += "/" + index(m_normals);
        }
        end();
    }

    void statement() {
        const std::string name(1, static_cast<char>('a' + below(4)));
        switch (below(12)) {
        case 0:
        case 1:
            return position();
        case 2:
            m_text += fmt::format("vt {} {}{}", number(), number(), below(8) == 0 ? " 0" : "");
            ++m_uvs;
            return end();
        case 3:
            m_text += fmt::format("vn {} {} {}", number(), number(), number());
            ++m_normals;
            return end();
        case 4:
            m_text += (below(3) > 0 ? "usemtl " : below(2) == 0 ? "o part " : "g group ") + name;
            return end();
        case 5:
            m_text += below(2) == 0 ? "s 1\n" : "# a comment\n\n";
            return;
        default:
            return face();
        }
    }

    std::mt19937 m_random;
    bool m_tiny;
    std::string m_text;
    int m_positions = 0, m_uvs = 0, m_normals = 0;
};

class ObjReader : public testing::Test {
  protected:
    using Read = ImportedModel (*)(const codec::ModelFolder&);

    ImportedModel read(const std::filesystem::path& file, Read reader) {
        const FileDescriptor fd(::open(file.c_str(), O_RDONLY));
        return reader(codec::ModelFolder(folder.path(), file.filename().string(), fd.get()));
    }

    test::TemporaryFolder folder;
};

TEST_F(ObjReader, TakesPlainFilesForWhatAssimpTakesThem) {
    // Where the system has another version, projects were never read by this one.
    if (aiGetVersionMajor() != 5 || aiGetVersionMinor() != 2)
        return;
    folder.write("a.mtl", std::string_view("newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n"));
    std::size_t read = 0;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        const std::string text = ObjFile(seed).text();
        const auto plain = readObjText(text);
        ASSERT_TRUE(plain.has_value()) << text;
        if (plain->runs.empty())
            continue;
        const auto file = folder.write("a.obj", std::string_view(text));
        const ImportedModel ours = this->read(file, &codec::readObj);
        const ImportedModel theirs = this->read(
            file, [](const codec::ModelFolder& of) { return codec::readWithAssimp(of, "obj"); });
        ++read;
        ASSERT_EQ(ours.meshes.size(), theirs.meshes.size()) << text;
        for (std::size_t i = 0; i < ours.meshes.size(); ++i)
            ASSERT_TRUE(*ours.meshes[i] == *theirs.meshes[i]) << "mesh " << i << " of\n" << text;
        ASSERT_EQ(ours.instances.size(), theirs.instances.size());
        for (std::size_t i = 0; i < ours.instances.size(); ++i) {
            EXPECT_EQ(ours.instances[i].name, theirs.instances[i].name);
            EXPECT_EQ(ours.instances[i].mesh, theirs.instances[i].mesh);
            EXPECT_EQ(ours.instances[i].material, theirs.instances[i].material);
            EXPECT_EQ(ours.instances[i].transform, theirs.instances[i].transform);
        }
        ASSERT_EQ(ours.materials.size(), theirs.materials.size());
        for (std::size_t i = 0; i < ours.materials.size(); ++i) {
            EXPECT_EQ(ours.materials[i].name, theirs.materials[i].name);
            EXPECT_EQ(ours.materials[i].baseColor, theirs.materials[i].baseColor);
        }
        EXPECT_EQ(ours.warnings, theirs.warnings);
        EXPECT_EQ(ours.format, theirs.format);
    }
    EXPECT_GT(read, 390u);
}

TEST_F(ObjReader, LeavesToAssimpWhatCouldBeTakenInTwoWays) {
    ASSERT_TRUE(readObjText(kTriangle).has_value());
    const std::string triangle = kTriangle;
    using namespace std::string_literals;
    for (const std::string& more : {
             "f 1 2"s,                      // an edge
             "l 1 2"s,                      // lines and points
             "p 1"s,                        //
             "cstype bezier"s,              // curves
             "f 1 2 3 1 2"s,                // more corners than four
             "f 1 2 4"s,                    // what is not there
             "f 1 2 0"s,                    //
             "f 1 2 -4"s,                   //
             "f 01 2 3"s,                   // Assimp counts digits
             "f 1/1 2/1 3/1"s,              // without texture coordinates
             "f 1 2 3 # remark"s,           //
             "f 1 2 99999999999999999999"s, //
             "v 1 2"s,                      // as many numbers as no vertex has
             "v 1 2 3 4 5"s,                //
             "v 1 2 3 0"s,                  // at infinity
             "v 1 2 nan"s,                  // no numbers
             "v 1 2 1e99"s,                 //
             "v 1 2 1,5"s,                  //
             "v 1 2 .5"s,                   // which Assimp does not count
             "v 1 2 3e"s,                   //
             "v 1 2 12345678901234567890"s, //
             "vt 1"s,                       //
             "vt 0 0 1"s,                   // a third dimension
             "vn 1 0"s,                     //
             "# goes on\\"s,                // on the next line
             "g a\\"s,                      //
             "g a\rf 1 2 3"s,               // two lines
             "g a\0b"s,                     //
             "vt 0 0\nf 1/1 2 3/1"s,        // corners of several kinds
         }) {
        SCOPED_TRACE(more);
        EXPECT_FALSE(readObjText(triangle + more + "\n").has_value());
    }
    EXPECT_FALSE(readObjText("").has_value());
    EXPECT_FALSE(readObjText(triangle.substr(0, triangle.size() - 1)).has_value()); // cut short
}

TEST_F(ObjReader, FacesOfOnePartMayStandApart) {
    const auto text = readObjText("v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 3\nv 0 0 1\n# x\nf 1 2 4\n"
                                  "s 1\nf 2 3 4\nusemtl m\nf 1 3 4\n");
    ASSERT_TRUE(text.has_value());
    ASSERT_EQ(text->runs.size(), 3u); // up to "s" and up to "usemtl"
    EXPECT_EQ(text->runs[1].firstFace, 2u);
    EXPECT_EQ(text->runs[1].firstCorner, 6u);
    EXPECT_EQ(text->outline, "o a\nv 0 0 0\nf 1 1 1\ns 1\nv 1 0 0\nf 2 2 2\nusemtl m\n"
                             "v 2 0 0\nf 3 3 3\n");
}

} // namespace
} // namespace patina

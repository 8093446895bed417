// Damaged and hostile documents end in an error that says what is wrong.
#include "tests/core/collada/Documents.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

// The first error of reading it and all of its meshes; empty: there is none.
std::string errorOf(const std::string& text, const ColladaLimits& limits = {}) {
    Result<ColladaDocument> document = ColladaDocument::parse(text, "test.dae", limits);
    if (!document)
        return document.error().text();
    for (std::size_t i = 0; i < document->instances().size(); ++i)
        if (Result<ColladaMesh> mesh = document->mesh(i); !mesh)
            return mesh.error().text();
    return {};
}

// Lights all that it can of what is read: the result is a document again.
void lightAll(ColladaDocument& document) {
    std::vector<ColladaLitMesh> meshes;
    for (std::size_t i = 0; i < document.instances().size(); ++i)
        if (Result<ColladaMesh> mesh = document.mesh(i); mesh && !mesh->mesh.indices.empty())
            meshes.push_back(litMesh(document, i));
    const std::size_t count = document.instances().size();
    const Result<std::vector<std::string>> notices =
        document.light(meshes, std::chrono::sys_seconds{});
    EXPECT_TRUE(notices.ok()) << notices.error().text();
    const Result<ColladaDocument> again = ColladaDocument::parse(document.text(), "lit.dae");
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->instances().size(), count);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos)
        throw std::runtime_error("the document has no " + from);
    return text.replace(at, from.size(), to);
}

} // namespace

TEST(ColladaHostile, EachFaultIsNamed) {
    struct Case {
        std::string from, to; // in the room
        const char* first;    // of the message
        const char* second;
    };
    const std::vector<Case> cases{
        {"version=\"1.4.1\"", "version=\"1.3\"", "COLLADA \"1.3\"", "export it as COLLADA 1.4"},
        {"count=\"12\">0 0 0", "count=\"13\">0 0 0", "Sq-p-a", "says that it has 13"},
        {"count=\"12\">0 0 0", "count=\"12\">NaN 0 0", "Sq-p-a", "\"NaN\""},
        {"count=\"12\">0 0 0", "count=\"12\">1e99 0 0", "Sq-p-a", "\"1e99\""},
        {"count=\"12\">0 0 0", "count=\"12\">inf 0 0", "Sq-p-a", "\"inf\""},
        {"count=\"12\">0 0 0", "count=\"-12\">0 0 0", "Sq-p-a", "no count"},
        {"#Sq-p-a\" count=\"4\"", "#Sq-p-a\" count=\"5\"", "Sq-p", "reaches beyond"},
        {"#Sq-p-a\" count=\"4\"", "#Sq-p-a\" count=\"18446744073709551615\"", "Sq-p", "beyond"},
        {"count=\"4\" stride=\"3\"", "count=\"4\" stride=\"0\"", "Sq-p", "beyond"},
        {"count=\"4\" stride=\"3\"", "count=\"4\" stride=\"9223372036854775808\"", "Sq-p",
         "beyond"},
        {"<accessor source=\"#Sq-p-a\"", "<accessor source=\"#Nowhere\"", "Nowhere", "not there"},
        {"<vcount>4</vcount><p>0", "<vcount>4</vcount><p>4", "index 4 of <source id=\"Sq-p\">",
         "last is 3"},
        {"<vcount>4</vcount><p>0", "<vcount>4</vcount><p>-1", "\"-1\"", "no index"},
        {"<vcount>4</vcount>", "<vcount>5</vcount>", "vcount", "5 corners"},
        {"<vcount>4</vcount>", "<vcount>2 2</vcount>", "polylist", "1 polygons"},
        {"<vcount>4</vcount>", "<vcount>4294967295</vcount>", "vcount", "4294967295"},
        {"<polylist count=\"1\"", "<polylist count=\"x\"", "polylist", "no count"},
        {"<triangles count=\"1\"", "<triangles count=\"2\"", "triangles", "has 1"},
        {"offset=\"2\"", "offset=\"999999999\"", "offset", "999999999"},
        {"offset=\"2\"", "", "offset", "no count"},
        {"instance_geometry url=\"#Square\"", "instance_geometry url=\"#Gone\"",
         "<instance_geometry> in <node id=\"Chair\">", "Gone"},
        {"instance_geometry url=\"#Square\"", "instance_geometry url=\"other.dae#Square\"",
         "another file", "as one file"},
        {"instance_node url=\"#Chair\"", "instance_node url=\"\"", "instance_node", "no <node>"},
        {"<translate sid=\"at\">0 0 2</translate>", "<instance_node url=\"#Chair\"/>",
         "<node id=\"Chair\">", "contains itself"},
        {"<translate sid=\"at\">0 0 2</translate>", "<instance_node url=\"#Left\"/>",
         "contains itself", "remove"},
        {"<translate sid=\"at\">0 0 2</translate>", "<translate>0 0</translate>",
         "<translate> in <node id=\"Chair\">", "2 numbers instead of 3"},
        {"<translate sid=\"at\">0 0 2</translate>", "<rotate>nan 0 0 1</rotate>", "rotate", "nan"},
        {"<translate sid=\"at\">0 0 2</translate>", "<lookat>0 0 0 0 1 0 0 1 0</lookat>", "lookat",
         "looks nowhere"},
        {"<translate sid=\"at\">0 0 2</translate>", "<skew>95 1 0 0 0 1 0</skew>", "skew",
         "matrices"},
        {"<translate sid=\"at\">0 0 2</translate>",
         "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1</matrix>", "matrix", "last row"},
        {"id=\"Right\"", "id=\"Chair\"", "two <node>", "rename"},
        {"meter=\"0.5\"", "meter=\"0\"", "unit", "positive"},
        {"meter=\"0.5\"", "meter=\"0,5\"", "unit", "with a dot"},
        {"Z_UP", "W_UP", "up_axis", "W_UP"},
        {"<instance_visual_scene url=\"#Scene\"", "<instance_visual_scene url=\"#No\"", "No",
         "not there"},
        {"target=\"#Red\"", "target=\"#Blue\"", "Blue", "not there"},
        {"url=\"#Red-fx\"", "url=\"#Blue-fx\"", "Blue-fx", "not there"},
        {"<source>srf</source>", "<source>xyz</source>", "xyz", "names no image"},
        {"texture=\"smp\"", "texture=\"xyz\"", "xyz", "neither a sampler"},
        {"<init_from>wood%20floor.png</init_from>", "<init_from/>", "Wood", "no file"},
        {"skin source=\"#Square\"", "skin source=\"#Skin\"", "Skin", "deforms itself"},
        {"<?xml version=\"1.0\" encoding=\"utf-8\"?>",
         "<!DOCTYPE COLLADA [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;\">]>", "DOCTYPE",
         "delete"},
    };
    ASSERT_EQ(errorOf(roomDocument()), "");
    for (const Case& c : cases) {
        SCOPED_TRACE(c.to);
        const std::string error = errorOf(replaced(roomDocument(), c.from, c.to));
        EXPECT_THAT(error, ::testing::StartsWith("test.dae: "));
        EXPECT_THAT(error, ::testing::HasSubstr(c.first));
        EXPECT_THAT(error, ::testing::HasSubstr(c.second));
    }
}

TEST(ColladaHostile, PolygonsWithHolesAreRefused) {
    const std::string error = errorOf(squareDocument(
        "<polygons count=\"1\"><input semantic=\"VERTEX\" source=\"#Sq-v\" offset=\"0\"/>"
        "<ph><p>0 1 2 3</p><h>0 1 2</h></ph></polygons>"));
    EXPECT_THAT(error, ::testing::HasSubstr("holes"));
    EXPECT_THAT(error, ::testing::HasSubstr("triangulate"));
}

TEST(ColladaHostile, NoDocumentAtAll) {
    EXPECT_THAT(errorOf(""), ::testing::HasSubstr("damaged or empty"));
    EXPECT_THAT(errorOf("<a>\n<b>"), ::testing::HasSubstr("cut short at line 2"));
    EXPECT_THAT(errorOf("<a/>"), ::testing::HasSubstr("root element is <a>"));
    EXPECT_THAT(errorOf("<COLLADA version=\"1.4.1\"/>"), ::testing::HasSubstr("visual_scene"));
    EXPECT_THAT(errorOf("<COLLADA version=\"1.4.1\"/><b/>"), ::testing::HasSubstr("more than one"));
    EXPECT_THAT(errorOf(squareDocument(kSquareAsQuad) + std::string(1, '\0')),
                ::testing::HasSubstr("no text"));
    EXPECT_EQ(ColladaDocument::read("/nowhere/a.dae").error().kind, ErrorKind::InputMissing);
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.dae";
    ASSERT_TRUE(writeFileAtomically(file, squareDocument(kSquareAsQuad)).ok());
    EXPECT_TRUE(ColladaDocument::read(file).ok());
    ColladaLimits small;
    small.fileBytes = 100;
    EXPECT_EQ(ColladaDocument::read(file, small).error().kind, ErrorKind::InputBroken);
}

TEST(ColladaHostile, DepthIsLimited) {
    for (const int depth : {10'000, 1'000'000}) {
        std::string open, close;
        for (int i = 0; i < depth; ++i) {
            open += "<node>";
            close += "</node>";
        }
        EXPECT_THAT(errorOf(documentOf("", open + close)), ::testing::HasSubstr("nested more"));
        EXPECT_THAT(errorOf("<COLLADA version=\"1.4.1\">" + open + close + "</COLLADA>"),
                    ::testing::HasSubstr("nested more"));
        // Also where the end is missing.
        EXPECT_NE(errorOf(open), "");
    }
}

TEST(ColladaHostile, ChainsOfNodesAreLimited) {
    // Each shows the next one twice: 2^40 nodes; or once: 2,000 deep.
    for (const int twice : {0, 1}) {
        std::string nodes;
        const int count = twice != 0 ? 40 : 2000;
        for (int i = 0; i < count; ++i) {
            const std::string next = fmt::format("<instance_node url=\"#n{}\"/>", i + 1);
            nodes += fmt::format("<node id=\"n{}\">{}{}</node>", i, next, twice != 0 ? next : "");
        }
        nodes += fmt::format("<node id=\"n{}\"/>", count);
        const std::string error = errorOf(documentOf("<library_nodes>" + nodes + "</library_nodes>",
                                                     "<node><instance_node url=\"#n0\"/></node>"));
        EXPECT_THAT(error, ::testing::HasSubstr(twice != 0 ? "1000000 nodes" : "nested more"));
    }
    ColladaLimits few;
    few.elements = 7;
    EXPECT_THAT(errorOf(roomDocument(), few), ::testing::HasSubstr("more than 7 pieces"));
}

// Cut anywhere, a document is an error; nothing crashes, hangs or reads what is not there.
TEST(ColladaHostile, CutAtEveryTag) {
    const std::string text = roomDocument();
    const std::size_t end = text.rfind("</COLLADA>") + 10;
    int cuts = 0;
    for (std::size_t at = 0; at < text.size(); ++at)
        if (text[at] == '<' || text[at] == '>' || text[at] == '"') {
            EXPECT_NE(errorOf(text.substr(0, at)), "") << "cut at " << at;
            ++cuts;
        }
    EXPECT_GT(cuts, 500);
    EXPECT_EQ(errorOf(text.substr(0, end)), "");
}

// What is well-formed but lacks an element, or has an attribute that is empty, is read or refused.
TEST(ColladaHostile, WithoutAnyAttributeOrElement) {
    const std::string text = roomDocument();
    int refused = 0, read = 0;
    for (std::size_t at = text.find("=\""); at != std::string::npos;
         at = text.find("=\"", at + 1)) {
        const std::size_t end = text.find('"', at + 2);
        const std::string without = text.substr(0, at + 2) + text.substr(end);
        ++(errorOf(without).empty() ? read : refused);
        if (Result<ColladaDocument> document = ColladaDocument::parse(without, "test.dae")) {
            EXPECT_TRUE(ColladaDocument::parse(document->text(), "test.dae").ok());
            lightAll(*document);
        }
    }
    EXPECT_GT(refused, 40);
    EXPECT_GT(read, 20);
}

// Characters of the document are replaced by others of it, or by worse.
TEST(ColladaHostile, RandomDamage) {
    const std::string text = roomDocument();
    const std::string worse = std::string("<>&;#\"'/ -.e0]") + '\0' + '\xff';
    std::mt19937 random(20);
    const auto below = [&](std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
    };
    int read = 0;
    for (int i = 0; i < 3000; ++i) {
        SCOPED_TRACE(fmt::format("seed 20, number {}", i));
        std::string damaged = text;
        for (std::size_t n = 1 + below(3); n > 0; --n)
            damaged[below(text.size())] =
                below(2) == 0 ? text[below(text.size())] : worse[below(worse.size())];
        if (Result<ColladaDocument> document = ColladaDocument::parse(damaged, "test.dae")) {
            lightAll(*document);
            ++read;
        }
    }
    EXPECT_GT(read, 100);
}

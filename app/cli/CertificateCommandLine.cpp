#include "app/cli/CommandParser.h"

namespace patina::cli {

void CommandParser::addCertificate() {
    CertificateOptions& o = m_certificate;
    radiosity::CertificateSettings& settings = o.settings;
    CLI::App* c = addCommand(m_app, "certificate",
                             "The Cornell box by path tracer and radiosity against its reference "
                             "irradiances",
                             o);
    c->add_option("-o,--output", o.output, "Also write the numbers as .json")->type_name("OUT");
    c->add_option("--samples", settings.paths, "Paths per point")
        ->check(plain(CLI::Range(64u, 1u << 28)))
        ->capture_default_str()
        ->type_name("N");
    const auto addResolution = [&](const char* option, int& resolution,
                                   radiosity::FactorMethod method, const char* help) {
        const radiosity::ResolutionRange range = radiosity::resolutionRange(method);
        c->add_option(option, resolution, help)
            ->check(plain(CLI::Range(range.lowest, range.highest)))
            ->capture_default_str()
            ->type_name("N");
    };
    addResolution("--rays", settings.rays, radiosity::FactorMethod::Rays,
                  "Rays per element of the raycast form factors");
    addResolution("--hemicube", settings.hemicube, radiosity::FactorMethod::Hemicube,
                  "Cells along a hemicube's edge, even");
    addResolution("--paraboloid", settings.paraboloid, radiosity::FactorMethod::Paraboloid,
                  "Texels along the diameter of a paraboloid map");
    addResolution("--analytic", settings.analytic, radiosity::FactorMethod::Analytic,
                  "Pairs of points for the visibility between two elements");
    c->add_option("--edge", settings.edge, "Longest edge of an element in metres")
        ->check(plain(CLI::Range(0.005, 1.0)))
        ->capture_default_str()
        ->type_name("METRES");
    c->add_option("--seed", settings.seed, "Seed of the sample patterns")
        ->capture_default_str()
        ->type_name("N");
    addThreads(c);
}

} // namespace patina::cli

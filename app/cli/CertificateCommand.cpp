// `patina certificate`: the Cornell box against reference values, estimator by estimator.
#include "app/cli/Commands.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/base/AtomicFile.h"
#include "core/base/LowerCase.h"
#include "core/radiosity/certificate/Certificate.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

using library::CornellPoint;
using library::kCornellChannels;
using radiosity::Certificate;
using radiosity::Estimator;
using radiosity::EstimatorSummary;

constexpr std::array kWallsNames{"measured walls", "usual walls"};
constexpr std::array kChannelNames{"red", "green", "blue"};

std::string pointName(const CornellPoint& point) {
    return fmt::format("{}, {}", point.blocks ? "with blocks" : "empty box", point.name);
}

std::string channelName(std::size_t channel) {
    return fmt::format("{}, {}", kWallsNames[channel / 3], kChannelNames[channel % 3]);
}

// "4 standard errors" or "2 %".
std::string toleranceText(const Estimator& estimator) {
    return estimator.radiosity ? fmt::format("{:g} %", 100.0 * Estimator::kRadiosityTolerance)
                               : fmt::format("{:g} standard errors", Estimator::kPathTolerance);
}

nlohmann::ordered_json referenceJson() {
    auto list = nlohmann::ordered_json::array();
    for (const CornellPoint& point : library::cornellPoints()) {
        const glm::dvec3 position = library::cornellPosition(point.position),
                         normal = library::cornellDirection(point.normal);
        nlohmann::ordered_json one = {{"point", point.name},
                                      {"blocks", point.blocks},
                                      {"position", {position.x, position.y, position.z}},
                                      {"normal", {normal.x, normal.y, normal.z}}};
        for (std::size_t c = 0; c < kCornellChannels; ++c) {
            one["irradiance"].push_back(point.irradiance(c));
            one["standardError"].push_back(point.standardError(c));
        }
        list.push_back(std::move(one));
    }
    return list;
}

nlohmann::ordered_json estimatorJson(const Estimator& estimator, const EstimatorSummary& summary) {
    nlohmann::ordered_json json = {{"name", estimator.name()}};
    if (estimator.radiosity) {
        json["formFactors"] = radiosity::name(estimator.radiosity->factors);
        json["solver"] = radiosity::name(estimator.radiosity->solver);
        json["tolerance"] = {{"relative", Estimator::kRadiosityTolerance}};
    } else {
        json["tolerance"] = {{"standardErrors", Estimator::kPathTolerance}};
    }
    json["holds"] = summary.holds();
    json["largestDeviation"] = summary.largest;
    json["largestAt"] = {{"point", library::cornellPoints()[summary.point].name},
                         {"blocks", library::cornellPoints()[summary.point].blocks},
                         {"channel", summary.channel}};
    json["meanDeviation"] = summary.mean;
    json["largestOfTolerance"] = summary.largestOfTolerance;
    if (summary.meanStandardError)
        json["meanStandardError"] = *summary.meanStandardError;
    for (std::size_t p = 0; p < estimator.irradiance.size(); ++p) {
        json["irradiance"].push_back(estimator.irradiance[p]);
        auto deviations = nlohmann::ordered_json::array();
        for (std::size_t c = 0; c < kCornellChannels; ++c)
            deviations.push_back(estimator.deviation(p, c));
        json["deviation"].push_back(std::move(deviations));
        if (!estimator.standardErrors.empty())
            json["standardError"].push_back(estimator.standardErrors[p]);
    }
    return json;
}

// A table for each point: a row for each estimator, values and deviations of each channel.
void printPoints(Report& report, const Certificate& certificate) {
    constexpr int kName = 24;
    report.line("Irradiance in W/m² below a light of radiance 1, and its deviation from the "
                "reference in %");
    const auto points = library::cornellPoints();
    for (std::size_t p = 0; p < points.size(); ++p) {
        report.line("");
        std::string line = fmt::format("{:<{}}", pointName(points[p]), 2 * kName);
        report.line(line);
        line = std::string(kName, ' ');
        for (std::size_t c = 0; c < kCornellChannels; ++c)
            line += fmt::format("  {:<15}", c % 3 == 0 ? kWallsNames[c / 3] : "");
        report.line(line);
        line = std::string(kName, ' ');
        for (std::size_t c = 0; c < kCornellChannels; ++c)
            line += fmt::format("  {:<15}", kChannelNames[c % 3]);
        report.line(line);
        line = fmt::format("{:<{}}", "reference", kName);
        for (std::size_t c = 0; c < kCornellChannels; ++c)
            line += fmt::format("  {:<15.6f}", points[p].irradiance(c));
        report.line(line);
        for (const Estimator& estimator : certificate.estimators) {
            line = fmt::format("{:<{}}", estimator.name(), kName);
            for (std::size_t c = 0; c < kCornellChannels; ++c)
                line += fmt::format("  {:.6f} {:+6.2f}", estimator.irradiance[p][c],
                                    100.0 * estimator.deviation(p, c));
            report.line(line);
        }
    }
}

void printSummary(Report& report, const Certificate& certificate,
                  const std::vector<EstimatorSummary>& summaries) {
    report.line("");
    report.line(fmt::format("{:<24}  {:>9}  {:>6}  {:>9}  {:<19}  {:<6}  {}", "Deviation in %",
                            "largest", "mean", "std error", "allowed", "", "largest at"));
    for (std::size_t i = 0; i < summaries.size(); ++i) {
        const EstimatorSummary& summary = summaries[i];
        const Estimator& estimator = certificate.estimators[i];
        report.line(fmt::format(
            "{:<24}  {:>9.2f}  {:>6.2f}  {:>9}  {:<19}  {:<6}  {}; {}", estimator.name(),
            100.0 * summary.largest, 100.0 * summary.mean,
            summary.meanStandardError ? fmt::format("{:.2f}", 100.0 * *summary.meanStandardError)
                                      : "-",
            toleranceText(estimator), summary.holds() ? "holds" : "FAILS",
            pointName(library::cornellPoints()[summary.point]), channelName(summary.channel)));
    }
}

} // namespace

Result<void> run(Session& session, const CertificateOptions& options) {
    const radiosity::CertificateSettings& settings = options.settings;
    if (!options.output.empty()) {
        const std::filesystem::path output = options.output;
        if (lowerCase(output.extension().string()) != ".json")
            return usageError(
                fmt::format("{}: the certificate is written as .json", output.filename().string()));
        if (Result<void> possible = checkOutput(output); !possible)
            return possible;
    }
    if (settings.hemicube % 2 != 0)
        return usageError(fmt::format("--hemicube is even, not {}", settings.hemicube));
    nlohmann::ordered_json& json = session.report().json();
    json["settings"] = {{"samples", settings.paths},     {"rays", settings.rays},
                        {"hemicube", settings.hemicube}, {"paraboloid", settings.paraboloid},
                        {"analytic", settings.analytic}, {"lightSamples", settings.lightSamples},
                        {"edge", settings.edge},         {"gatherRays", settings.gatherRays},
                        {"residual", settings.residual}, {"seed", settings.seed}};
    session.beginPhase();
    const Result<Certificate> certificate = makeCertificate(settings, session.job());
    if (!certificate)
        return certificate.error();
    session.endProgress();

    json["counts"] = {{"elementsEmpty", certificate->elementsEmpty},
                      {"elementsWithBlocks", certificate->elementsWithBlocks}};
    for (std::size_t c = 0; c < kCornellChannels; ++c)
        json["channels"].push_back(channelName(c));
    json["reference"] = referenceJson();
    std::vector<EstimatorSummary> summaries;
    bool holds = true;
    for (const Estimator& estimator : certificate->estimators) {
        summaries.push_back(summarize(estimator));
        holds = holds && summaries.back().holds();
        json["estimators"].push_back(estimatorJson(estimator, summaries.back()));
    }
    json["holds"] = holds;
    printPoints(session.report(), *certificate);
    printSummary(session.report(), *certificate, summaries);
    if (!options.output.empty()) {
        const std::string text = json.dump(2) + "\n";
        if (Result<void> written = writeFileAtomically(options.output, text); !written)
            return written;
        session.report().output(options.output,
                                fmt::format("{} estimators", certificate->estimators.size()));
    }
    for (std::size_t i = 0; i < summaries.size(); ++i)
        if (!summaries[i].holds())
            session.report().failCheck(fmt::format(
                "{} is off by {:.2f} times what is allowed, {}", certificate->estimators[i].name(),
                summaries[i].largestOfTolerance, toleranceText(certificate->estimators[i])));
    return {};
}

} // namespace patina::cli

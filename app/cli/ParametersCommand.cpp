#include "app/cli/Commands.h"
#include "core/edit/ParameterReference.h"
#include "core/edit/Parameters.h"

#include <nlohmann/json.hpp>

namespace patina::cli {

Result<void> run(Session& session, const ParametersOptions& options) {
    Report& report = session.report();
    report.json().update(nlohmann::ordered_json::parse(parametersAsJson()));
    if (options.markdown) {
        std::string page = parametersAsMarkdown();
        while (page.ends_with('\n'))
            page.pop_back();
        report.line(page);
        return {};
    }
    std::string group;
    std::vector<std::pair<std::string, std::string>> rows;
    for (const ParameterInfo& info : parameters())
        rows.emplace_back(info.id, info.help);
    report.table({}, rows);
    return {};
}

} // namespace patina::cli

#include "app/editor/viewport/EquationText.h"

#include "app/editor/document/QtText.h"
#include "app/editor/trace/TraceWork.h"
#include "core/document/ViewChoices.h"

#include <QCoreApplication>
#include <QStringList>

namespace patina::editor {
namespace {

QString withConstant(const QString& name, float constant) {
    if (constant == 1.0f)
        return name;
    if (constant < 1.0f) // 1/π
        return name + QStringLiteral(" / π");
    return QStringLiteral("%1 %2").arg(static_cast<double>(constant)).arg(name);
}

QString symbol(ViewKind kind) {
    const ViewInfo& info = viewInfo(kind);
    return toQString(info.symbol.empty() ? info.label : info.symbol);
}

} // namespace

QString labelText(ViewKind kind, LightingMode lighting) {
    if (kind == shading::kViewDiffuseIbl && lighting == LightingMode::Radiosity)
        return QCoreApplication::translate("EquationText", "Radiosity");
    if (kind == shading::kViewDiffuseIbl &&
        (lighting == LightingMode::Unshadowed || lighting == LightingMode::Shadowed ||
         lighting == LightingMode::Prt))
        return QCoreApplication::translate("EquationText", "Diffuse transfer");
    return toQString(viewInfo(kind).label);
}

QString partText(const EquationPart& part, LightingMode lighting) {
    return withConstant(labelText(part.kind, lighting), part.constant);
}

QString beforeText(const Equation& equation, std::size_t index) {
    if (index == 0) {
        for (std::size_t i = 1; i < equation.parts.size(); ++i)
            if (closesBracket(equation, i))
                return QStringLiteral("(");
        return {};
    }
    const QString bracket = closesBracket(equation, index) ? QStringLiteral(") ") : QString();
    switch (equation.parts[index].join) {
    case Join::Plus:
        return bracket + QStringLiteral("+");
    case Join::Times:
        return bracket + QStringLiteral("×");
    case Join::Over:
        return bracket + QStringLiteral("÷");
    }
    return {};
}

QString formulaText(const Equation& equation, LightingMode lighting) {
    const bool isSum = equation.opened == shading::kViewFinal;
    QStringList words{QStringLiteral("=")};
    for (std::size_t i = 0; i < equation.parts.size(); ++i) {
        const EquationPart& part = equation.parts[i];
        if (const QString before = beforeText(equation, i); !before.isEmpty())
            words << before;
        // The sum by names, products by symbols.
        QString name =
            isSum ? labelText(part.kind, lighting) : withConstant(symbol(part.kind), part.constant);
        const bool sum = name.contains(QLatin1Char('+')), over = part.join == Join::Over;
        if (sum || (over && part.constant != 1.0f))
            name = QStringLiteral("(%1)").arg(name);
        words << name;
    }
    const QString formula = words.join(QLatin1Char(' '));
    return isSum ? labelText(equation.opened, lighting) + QLatin1Char(' ') + formula : formula;
}

// As in docs/maths/path-tracing.md and docs/maths/whitted.md.
QString tracedFormulaText(TracedBy tracer, LocalModel model) {
    if (tracer == TracedBy::Paths)
        return QStringLiteral("L = Lₑ + ∫ f(v, l) L(l) (n·l) dl");
    return model == LocalModel::Whitted1980
               ? QStringLiteral("I = Ia ka + Σ S Ip [kd (N·L) + ks (R·V)ⁿ] + ks Ir + kt It")
               : QStringLiteral("I = Ia ka + Σ S Ip f(V, L) (N·L) + ks Ir + kt It");
}

QString tracedNoteText(TracedBy tracer) {
    return tracer == TracedBy::Paths
               ? QCoreApplication::translate(
                     "EquationText", "The picture is path traced: what a surface gives off, and "
                                     "all light that arrives at it, by whichever way. It is no "
                                     "sum of the terms that the viewport draws; F12 leads back "
                                     "to these.")
               : QCoreApplication::translate(
                     "EquationText", "The picture is that of the classical ray tracer: ambient "
                                     "light, the lights that a ray reaches, and what one mirrored "
                                     "and one refracted ray bring. It is no sum of the terms that "
                                     "the viewport draws; Shift+F12 leads back to these.");
}

QString withoutText(const std::array<bool, kTermCount>& terms, LightingMode lighting) {
    QStringList missing;
    for (std::size_t i = 0; i < terms.size(); ++i)
        if (!terms[i])
            missing << labelText(kTermViews[i], lighting);
    return QCoreApplication::translate("EquationText", "The picture lacks %1")
        .arg(missing.join(QStringLiteral(", ")));
}

} // namespace patina::editor

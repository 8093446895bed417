#include "app/editor/style/Style.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"

#include <QApplication>
#include <QColor>
#include <QFile>
#include <QFont>
#include <QPalette>
#include <QProxyStyle>
#include <QTreeView>

namespace patina::editor {
namespace {

using namespace tokens;

QPalette palette() {
    QPalette palette;
    const auto set = [&](QPalette::ColorRole role, QRgb normal, QRgb disabled) {
        palette.setColor(QPalette::Active, role, QColor(normal));
        palette.setColor(QPalette::Inactive, role, QColor(normal));
        palette.setColor(QPalette::Disabled, role, QColor(disabled));
    };
    set(QPalette::Window, kWindow, kWindow);
    set(QPalette::WindowText, kText, kTextOff);
    set(QPalette::Base, kWell, kPanel);
    set(QPalette::AlternateBase, kPanel, kPanel);
    set(QPalette::Text, kText, kTextOff);
    set(QPalette::PlaceholderText, kTextOff, kTextOff);
    set(QPalette::Button, kRaised, kPanel);
    set(QPalette::ButtonText, kText, kTextOff);
    set(QPalette::BrightText, kDanger, kDanger);
    set(QPalette::Highlight, kAccentDeep, kRaised);
    set(QPalette::HighlightedText, kText, kTextOff);
    set(QPalette::ToolTipBase, kRaised, kRaised);
    set(QPalette::ToolTipText, kText, kText);
    set(QPalette::Link, kAccent, kTextOff);
    set(QPalette::LinkVisited, kAccent, kTextOff);
    set(QPalette::Light, kHover, kHover);
    set(QPalette::Midlight, kRaised, kRaised);
    set(QPalette::Mid, kLine, kLine);
    set(QPalette::Dark, kWell, kWell);
    set(QPalette::Shadow, 0xff0c0d0e, 0xff0c0d0e);
    return palette;
}

// The style sheet with every @name replaced by its token.
QString styleSheet() {
    QFile file(QStringLiteral(":/style/patina.qss"));
    if (!file.open(QIODevice::ReadOnly))
        return {};
    QString sheet = QString::fromUtf8(file.readAll());
    const struct {
        const char* name;
        QRgb color;
    } table[] = {{"@well", kWell},       {"@window", kWindow},
                 {"@panel", kPanel},     {"@raised", kRaised},
                 {"@hover", kHover},     {"@line", kLine},
                 {"@textDim", kTextDim}, {"@textOff", kTextOff},
                 {"@text", kText},       {"@accentDeep", kAccentDeep},
                 {"@accent", kAccent},   {"@focus", kFocus},
                 {"@copper", kCopper},   {"@danger", kDanger}};
    for (const auto& [name, color] : table)
        sheet.replace(QLatin1String(name), QColor(color).name());
    sheet.replace(QLatin1String("@radius"), QStringLiteral("%1px").arg(kRadius));
    return sheet;
}

class PatinaStyle : public QProxyStyle {
  public:
    PatinaStyle()
        : QProxyStyle(QStringLiteral("Fusion")) {}
    using QProxyStyle::polish;
    void polish(QWidget* widget) override {
        // The ring is around a row, not around the first of its columns and the indent before it.
        if (auto* tree = qobject_cast<QTreeView*>(widget))
            tree->setAllColumnsShowFocus(true);
        QProxyStyle::polish(widget);
    }
    int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                  QStyleHintReturn* data) const override {
        switch (hint) {
        case SH_DialogButtonBox_ButtonsHaveIcons: // words are enough
        case SH_EtchDisabledText:
            return 0;
        default:
            return QProxyStyle::styleHint(hint, option, widget, data);
        }
    }
    int pixelMetric(PixelMetric metric, const QStyleOption* option,
                    const QWidget* widget) const override {
        // About both sides of a dock's buttons together: with their icons they are 20 px and more.
        if (metric == PM_DockWidgetTitleBarButtonMargin)
            return 10;
        return QProxyStyle::pixelMetric(metric, option, widget);
    }
};

} // namespace

void applyStyle(QApplication& application) {
    QApplication::setStyle(new PatinaStyle);
    QApplication::setPalette(palette());
    application.setStyleSheet(styleSheet());
}

} // namespace patina::editor

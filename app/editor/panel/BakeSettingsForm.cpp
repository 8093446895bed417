#include "app/editor/panel/BakeSettingsForm.h"

#include "app/editor/job/BakeService.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/FoldButton.h"
#include "app/editor/widget/TextButton.h"
#include "core/bake/Bake.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLocale>
#include <QPushButton>
#include <algorithm>
#include <limits>

namespace patina::editor {
namespace {

using Type = BakeOption::Type;

void showInCombo(QWidget* field, const BakeOption& option, double value) {
    auto* box = static_cast<QComboBox*>(field);
    int index = box->findData(value);
    if (index < 0) { // a file or the command line asked for something unusual
        box->addItem(QLocale().toString(value, 'f', 0) + QLatin1String(option.unit), value);
        index = box->count() - 1;
    }
    box->setCurrentIndex(index);
}

void showInSpin(QWidget* field, const BakeOption& /*option*/, double value) {
    static_cast<QDoubleSpinBox*>(field)->setValue(value);
}

void showInCheck(QWidget* field, const BakeOption& /*option*/, double value) {
    static_cast<QCheckBox*>(field)->setChecked(value != 0.0);
}

// What presets set is no change of the user's.
bool ofPreset(const BakeOption& option) {
    return std::ranges::any_of(bakePresets(), [&](const BakePreset& preset) {
        const BakeRequest usual;
        return option.get(withPreset(usual, preset)) != option.get(usual);
    });
}

} // namespace

BakeSettingsForm::BakeSettingsForm(QWidget* parent)
    : QWidget(parent)
    , m_form(new QFormLayout(this)) {
    m_form->setContentsMargins(0, 0, 0, 0);
    m_form->setHorizontalSpacing(tokens::kMargin);
    m_form->setVerticalSpacing(tokens::kGap);
    m_form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    m_kind = new QComboBox;
    for (const BakeKind kind : {BakeKind::PrtVertex, BakeKind::PrtTexel, BakeKind::AoTexel,
                                BakeKind::AoVertex, BakeKind::LightMap}) {
        m_kind->addItem(bakeTitle(kind), static_cast<int>(kind));
        m_requests[kind].kind = kind;
    }
    m_kind->setObjectName(QStringLiteral("bakeKind"));
    m_kind->setAccessibleName(tr("What to bake"));
    m_kind->setToolTip(tr("What to compute and attach to the scene"));
    m_kind->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_form->addRow(m_kind);
    connect(m_kind, &QComboBox::currentIndexChanged, this, &BakeSettingsForm::refresh);
    m_form->addRow(m_presetRow = makePresets());
    for (const bool advanced : {false, true}) {
        if (advanced)
            m_form->addRow(makeFold());
        for (const BakeOption& option : bakeOptions())
            if (option.advanced == advanced)
                m_rows.push_back(makeRow(option));
    }
    refresh();
}

QWidget* BakeSettingsForm::makePresets() {
    auto* row = new QWidget;
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(1); // parts of one switch
    for (const BakePreset& preset : bakePresets()) {
        QPushButton* button =
            makeTextButton(QCoreApplication::translate("BakePresets", preset.label),
                           QCoreApplication::translate("BakePresets", preset.help));
        button->setCheckable(true);
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // all of one width
        button->setObjectName(QStringLiteral("bakePreset-") + QLatin1String(preset.name));
        connect(button, &QPushButton::clicked, this, [this, &preset] {
            m_requests[kind()] = withPreset(m_requests[kind()], preset);
            m_edited.insert(kind());
            refresh();
        });
        layout->addWidget(button, 1);
        m_presets.emplace_back(&preset, button);
    }
    return row;
}

QWidget* BakeSettingsForm::makeFold() {
    m_advanced = new FoldButton(tr("Advanced"), QStringLiteral("bake/advancedFolded"));
    m_advanced->setObjectName(QStringLiteral("bakeAdvanced"));
    m_advanced->setFolded(m_advanced->remembered(true));
    connect(m_advanced, &QToolButton::clicked, this, [this] {
        m_advanced->setFolded(!m_advanced->isFolded());
        refresh();
    });
    return m_advanced;
}

void BakeSettingsForm::describePresets(const std::function<QString(const BakeRequest&)>& describe) {
    for (const auto& [preset, button] : m_presets) {
        const QString label = QCoreApplication::translate("BakePresets", preset->label);
        const QString more = describe(withPreset(m_requests[kind()], *preset));
        button->setText(more.isEmpty() ? label : label + QLatin1Char('\n') + more);
    }
}

BakeSettingsForm::Row BakeSettingsForm::makeRow(const BakeOption& option) {
    Row row{&option, nullptr, nullptr};
    if (option.type == Type::Toggle) {
        auto* box = new QCheckBox;
        connect(box, &QCheckBox::toggled, this,
                [this, &option](bool on) { edit(option, on ? 1.0 : 0.0); });
        row.field = box;
        row.show = showInCheck;
    } else if (option.type == Type::Choice || !option.steps.empty()) {
        auto* box = new QComboBox;
        for (std::size_t i = 0; i < option.choices.size(); ++i)
            box->addItem(QCoreApplication::translate("BakeOptions", option.choices[i].label),
                         static_cast<double>(i));
        for (const int step : option.steps)
            box->addItem(QLocale().toString(step) + QLatin1String(option.unit),
                         static_cast<double>(step));
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        connect(box, &QComboBox::currentIndexChanged, this,
                [this, &option, box] { edit(option, box->currentData().toDouble()); });
        row.field = box;
        row.show = showInCombo;
    } else {
        auto* box = new QDoubleSpinBox;
        const bool whole = option.type == Type::Integer;
        box->setRange(option.min, option.max);
        box->setDecimals(whole ? 0 : option.max <= 1.0 ? 5 : 3);
        box->setSingleStep(whole ? 1.0 : option.max <= 1.0 ? 0.0005 : 0.1);
        box->setSuffix(QLatin1String(option.unit));
        box->setSpecialValueText(QCoreApplication::translate("BakeOptions", option.zeroText));
        box->setKeyboardTracking(false);
        connect(box, &QDoubleSpinBox::valueChanged, this,
                [this, &option](double value) { edit(option, value); });
        row.field = box;
        row.show = showInSpin;
    }
    const QString label = QCoreApplication::translate("BakeOptions", option.label);
    const QString help = QCoreApplication::translate("BakeOptions", option.help);
    QString name = QLatin1String(option.name);
    name[0] = name[0].toUpper();
    row.field->setObjectName(QStringLiteral("bake") + name);
    row.field->setAccessibleName(label);
    row.field->setToolTip(help);
    row.field->setStatusTip(help);
    m_form->addRow(label, row.field);
    m_form->labelForField(row.field)->setToolTip(help);
    return row;
}

BakeKind BakeSettingsForm::kind() const {
    return static_cast<BakeKind>(m_kind->currentData().toInt());
}

BakeRequest BakeSettingsForm::requestFor(BakeKind kind) const {
    return m_requests.at(kind);
}

void BakeSettingsForm::setRequest(const BakeRequest& request) {
    BakeRequest& mine = m_requests[request.kind];
    const BakeRequest before = mine;
    mine = request;
    for (const BakeOption& option : bakeOptions())
        if (!option.shapesResult)
            option.set(mine, option.get(before));
    m_edited.erase(request.kind);
    if (request.kind == kind())
        refresh();
}

void BakeSettingsForm::follow(const BakeRequest& request) {
    if (!m_edited.contains(request.kind) ||
        settingsText(normalized(m_requests[request.kind])) == settingsText(normalized(request)))
        setRequest(request);
}

void BakeSettingsForm::showKind(BakeKind kind) {
    m_kind->setCurrentIndex(m_kind->findData(static_cast<int>(kind)));
}

void BakeSettingsForm::edit(const BakeOption& option, double value) {
    if (m_refreshing)
        return;
    option.set(m_requests[kind()], value);
    m_edited.insert(kind());
    refresh(); // which settings apply may have changed
}

void BakeSettingsForm::refresh() {
    m_refreshing = true;
    const BakeRequest& request = m_requests[kind()];
    const BakeRequest usual{request.kind, {}, {}};
    int unusual = 0; // of those that may be folded away
    for (const Row& row : m_rows) {
        const bool applies = row.option->applies(request);
        const bool shown = applies && !(row.option->advanced && m_advanced->isFolded());
        row.field->setVisible(shown);
        m_form->labelForField(row.field)->setVisible(shown);
        row.show(row.field, *row.option, row.option->get(request));
        if (applies && row.option->advanced && !ofPreset(*row.option) &&
            row.option->get(request) != row.option->get(usual))
            ++unusual;
    }
    m_advanced->setText(unusual > 0 ? tr("Advanced (%1 changed)").arg(unusual) : tr("Advanced"));
    const auto textOf = [&](const BakePreset& preset) {
        return settingsText(withPreset(request, preset));
    };
    m_presetRow->setVisible(textOf(bakePresets().front()) != textOf(bakePresets().back()));
    const BakePreset* chosen = presetOf(request);
    for (const auto& [preset, button] : m_presets)
        button->setChecked(preset == chosen);
    m_refreshing = false;
    Q_EMIT changed();
}

} // namespace patina::editor

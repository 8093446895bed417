// The rows for each type of parameter.

#include "app/editor/document/FileKinds.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/panel/BouncesRow.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ColorButton.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QWheelEvent>

namespace patina::editor {
namespace {

// "45°", but "0.5 EV".
QString unitText(std::string_view text) {
    const QString unit = toQString(text);
    return unit.isEmpty() || unit == QStringLiteral("°") ? unit : QStringLiteral(" ") + unit;
}

NumberFormat formatOf(const ParameterInfo& info) {
    NumberFormat format{info.softMin,  info.softMax, info.hardMin,       info.hardMax,
                        info.decimals, info.wraps,   unitText(info.unit)};
    if (!info.zeroName.empty())
        format.name = [name = toQString(info.zeroName)](double value) {
            return value == 0.0 ? name : QString();
        };
    return format;
}

class FloatRow : public ParameterRow {
  public:
    FloatRow(const ParameterInfo& info, const RowContext& context)
        : ParameterRow(info, context)
        // A range around zero fills from zero, so that the eye sees the sign.
        , m_slider(new Slider(info.softMin, info.softMax,
                              info.softMin < 0 && info.softMax > 0 ? 0 : info.softMin))
        , m_field(new NumberField(formatOf(info))) {
        m_field->setFixedWidth(tokens::kFieldWidth);
        addField(m_slider, 1);
        addField(m_field);
        m_field->setToolTip(tr("%1\nDrag to change, Shift for fine and Ctrl for coarse steps; "
                               "click to type.")
                                .arg(toQString(info.help)));
        const auto dragged = [this](double value) { drag(static_cast<float>(value)); };
        connect(m_slider, &Slider::dragStarted, this, &FloatRow::beginDrag);
        connect(m_slider, &Slider::dragged, this, dragged);
        connect(m_slider, &Slider::dragFinished, this, &FloatRow::endDrag);
        connect(m_field, &NumberField::dragStarted, this, &FloatRow::beginDrag);
        connect(m_field, &NumberField::dragged, this, dragged);
        connect(m_field, &NumberField::dragFinished, this, &FloatRow::endDrag);
        connect(m_field, &NumberField::stepped, this,
                [this](double value) { step(static_cast<float>(value)); });
        connect(m_field, &NumberField::edited, this,
                [this](double value) { edit(static_cast<float>(value)); });
    }

  protected:
    void show(const ParameterValue& value) override {
        if (info().unitOf)
            m_field->setUnit(
                unitText(info().unitFor(context().controller.document(), target()->id)));
        m_slider->setValue(std::get<float>(value));
        m_field->setValue(std::get<float>(value));
    }

  private:
    Slider* m_slider;
    NumberField* m_field;
};

class VectorRow : public ParameterRow {
  public:
    VectorRow(const ParameterInfo& info, const RowContext& context)
        : ParameterRow(info, context) {
        const QString axes[3] = {QStringLiteral(" X"), QStringLiteral(" Y"), QStringLiteral(" Z")};
        NumberFormat format = formatOf(info);
        format.decimals = std::min(format.decimals, 2);
        format.unit.clear(); // three fields leave no room for it
        for (int i = 0; i < 3; ++i) {
            auto* field = m_fields[i] = new NumberField(format);
            field->setMinimumWidth(44);
            addField(field, 1);
            describe(field, axes[i]);
            connect(field, &NumberField::dragStarted, this, &VectorRow::beginDrag);
            connect(field, &NumberField::dragged, this, [=, this](double v) { drag(with(i, v)); });
            connect(field, &NumberField::dragFinished, this, &VectorRow::endDrag);
            connect(field, &NumberField::stepped, this, [=, this](double v) { step(with(i, v)); });
            connect(field, &NumberField::edited, this, [=, this](double v) { edit(with(i, v)); });
        }
    }

  protected:
    void show(const ParameterValue& value) override {
        for (int i = 0; i < 3; ++i)
            m_fields[i]->setValue(std::get<glm::vec3>(value)[i]);
    }

  private:
    [[nodiscard]] glm::vec3 with(int component, double value) const {
        const auto now = current();
        glm::vec3 vector = now ? std::get<glm::vec3>(*now) : glm::vec3(0);
        vector[component] = static_cast<float>(value);
        return vector;
    }
    NumberField* m_fields[3];
};

class ColorRow : public ParameterRow {
  public:
    ColorRow(const ParameterInfo& info, const RowContext& context)
        : ParameterRow(info, context)
        , m_button(new ColorButton) {
        addField(m_button, 1);
        connect(m_button, &ColorButton::dragStarted, this, &ColorRow::beginDrag);
        connect(m_button, &ColorButton::dragged, this,
                [this](const glm::vec3& color) { drag(color); });
        connect(m_button, &ColorButton::dragFinished, this, &ColorRow::endDrag);
        connect(m_button, &ColorButton::edited, this,
                [this](const glm::vec3& color) { edit(color); });
    }

  protected:
    void show(const ParameterValue& value) override {
        m_button->setColor(std::get<glm::vec3>(value));
    }

  private:
    ColorButton* m_button;
};

// A combo box that leaves the wheel to the panel unless it has the focus.
class ChoiceBox : public QComboBox {
  protected:
    void wheelEvent(QWheelEvent* event) override {
        if (hasFocus())
            QComboBox::wheelEvent(event);
        else
            event->ignore();
    }
};

class ChoiceRow : public ParameterRow {
  public:
    ChoiceRow(const ParameterInfo& info, const RowContext& context)
        : ParameterRow(info, context)
        , m_box(new ChoiceBox) {
        m_box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        m_box->setMinimumContentsLength(6);
        m_box->setFocusPolicy(Qt::StrongFocus);
        addField(m_box, 1);
        connect(m_box, &QComboBox::activated, this,
                [this](int index) { edit(m_box->itemData(index).toInt()); });
    }

  protected:
    void show(const ParameterValue& value) override {
        const int current = std::get<int>(value);
        offer(current);
        m_box->setCurrentIndex(m_box->findData(current));
    }

  private:
    // The choices that can be made, and the one that was made, whether it can be or not.
    void offer(int current) {
        const Document& document = context().controller.document();
        std::vector<int> offered;
        for (int i = 0; i < static_cast<int>(info().choices.size()); ++i)
            if (i == current || whyUnavailable(info(), document, i).empty())
                offered.push_back(i);
        if (offered == m_offered)
            return;
        m_offered = offered;
        m_box->clear();
        for (const int i : offered)
            m_box->addItem(toQString(info().choiceLabels[static_cast<std::size_t>(i)]), i);
    }

    QComboBox* m_box;
    std::vector<int> m_offered;
};

class BoolRow : public ParameterRow {
  public:
    BoolRow(const ParameterInfo& info, const RowContext& context)
        : ParameterRow(info, context)
        , m_box(new QCheckBox) {
        m_box->setMinimumHeight(tokens::kRowHeight - 2);
        addField(m_box, 1);
        connect(m_box, &QCheckBox::clicked, this, [this](bool checked) { edit(checked); });
    }

  protected:
    void show(const ParameterValue& value) override { m_box->setChecked(std::get<bool>(value)); }

  private:
    QCheckBox* m_box;
};

class MapRow : public ParameterRow {
  public:
    MapRow(const ParameterInfo& info, const RowContext& context)
        : ParameterRow(info, context)
        , m_slot(new MapSlotWidget(context.thumbnails, toQString(info.label),
                                   info.mapChannel == MapChannel::Rgb)) {
        addField(m_slot, 1);
        connect(m_slot, &MapSlotWidget::browseRequested, this, &MapRow::browse);
        connect(m_slot, &MapSlotWidget::fileDropped, this, &MapRow::load);
        connect(m_slot, &MapSlotWidget::clearRequested, this, [this] {
            if (const auto element = target())
                this->context().controller.clearMap(this->info(), *element);
        });
        connect(m_slot, &MapSlotWidget::channelChosen, this, [this](MapChannel channel) {
            if (const auto now = current()) {
                auto slot = std::get<MapSlot>(*now);
                slot.channel = channel;
                edit(slot);
            }
        });
        connect(m_slot, &MapSlotWidget::tilingDragStarted, this, &MapRow::beginDrag);
        connect(m_slot, &MapSlotWidget::tilingDragged, this,
                [this](const MapSlot& slot) { drag(slot); });
        connect(m_slot, &MapSlotWidget::tilingDragFinished, this, &MapRow::endDrag);
        connect(m_slot, &MapSlotWidget::tilingEdited, this,
                [this](const MapSlot& slot) { edit(slot); });
    }

  protected:
    void show(const ParameterValue& value) override { m_slot->setSlot(std::get<MapSlot>(value)); }

  private:
    void load(const QString& file) {
        if (const auto element = target())
            context().controller.setMap(info(), *element, file);
    }

    void browse() {
        const QString key = QStringLiteral("folders/images");
        DocumentController& controller = context().controller;
        auto* dialog = new QFileDialog(window(), tr("Choose %1").arg(toQString(info().label)),
                                       proposedFolder(controller, key), imageFilter());
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setFileMode(QFileDialog::ExistingFile);
        connect(dialog, &QFileDialog::fileSelected, this,
                [this, key, &controller](const QString& file) {
                    rememberFolder(controller, key, file);
                    load(file);
                });
        dialog->open();
    }

    MapSlotWidget* m_slot;
};

} // namespace

ParameterRow* makeParameterRow(const ParameterInfo& info, const RowContext& context) {
    if (info.id == "view.bounces")
        return new BouncesRow(info, context);
    switch (info.type) {
    case ParameterType::Bool:
        return new BoolRow(info, context);
    case ParameterType::Float:
        return new FloatRow(info, context);
    case ParameterType::Color:
        return new ColorRow(info, context);
    case ParameterType::Vector:
        return new VectorRow(info, context);
    case ParameterType::Choice:
        return new ChoiceRow(info, context);
    case ParameterType::Map:
        return new MapRow(info, context);
    case ParameterType::Text: // names are edited where they are listed
    case ParameterType::Reference:
        return nullptr;
    }
    return nullptr;
}

} // namespace patina::editor

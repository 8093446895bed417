// What to bake and how finely: three presets, a row for each setting that applies
// (core/bake/domain/BakeOptions.h), the advanced ones folded away. Kept for each kind of bake.
#pragma once

#include "core/bake/domain/BakeOptions.h"
#include "core/bake/domain/BakePresets.h"

#include <QWidget>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

class QComboBox;
class QFormLayout;
class QPushButton;

namespace patina::editor {

class FoldButton;

class BakeSettingsForm : public QWidget {
    Q_OBJECT
  public:
    explicit BakeSettingsForm(QWidget* parent = nullptr);

    [[nodiscard]] BakeRequest request() const { return requestFor(kind()); }
    // What the form would ask for if it showed that kind.
    [[nodiscard]] BakeRequest requestFor(BakeKind kind) const;
    // What the request says of its kind. What it does not say, because it does not shape the
    // result, stays as it is.
    void setRequest(const BakeRequest& request);
    // The same, unless the user has changed something since.
    void follow(const BakeRequest& request);
    void showKind(BakeKind kind);
    // What each preset says below its name, such as how long it takes; empty: nothing.
    void describePresets(const std::function<QString(const BakeRequest&)>& describe);

  Q_SIGNALS:
    void changed();

  private:
    // Shows and reads one setting.
    struct Row {
        const BakeOption* option;
        QWidget* field;
        void (*show)(QWidget* field, const BakeOption& option, double value);
    };
    [[nodiscard]] BakeKind kind() const;
    Row makeRow(const BakeOption& option);
    [[nodiscard]] QWidget* makePresets();
    [[nodiscard]] QWidget* makeFold();
    void edit(const BakeOption& option, double value);
    void refresh();

    QFormLayout* m_form;
    QComboBox* m_kind;
    QWidget* m_presetRow;
    std::vector<std::pair<const BakePreset*, QPushButton*>> m_presets;
    FoldButton* m_advanced;
    std::vector<Row> m_rows;
    std::map<BakeKind, BakeRequest> m_requests;
    std::set<BakeKind> m_edited; // since setRequest()
    bool m_refreshing = false;
};

} // namespace patina::editor

#include "tests/core/collada/Documents.h"

namespace patina::test {

std::string roomDocument(const std::string& version) {
    const bool is15 = version.starts_with("1.5");
    const std::string image = is15 ? "<init_from><ref>wood%20floor.png</ref></init_from>"
                                   : "<init_from>wood%20floor.png</init_from>";
    const std::string sampler =
        is15
            ? R"(<newparam sid="smp"><sampler2D><instance_image url="#Wood"/></sampler2D></newparam>)"
            : R"(<newparam sid="srf"><surface type="2D"><init_from>Wood</init_from></surface></newparam>
        <newparam sid="smp"><sampler2D><source>srf</source></sampler2D></newparam>)";
    const std::string second =
        R"(<triangles count="1" material="other"><input semantic="VERTEX" source="#Sq-v" offset="0"/><p>0 1 2</p></triangles>
      <lines count="1"><input semantic="VERTEX" source="#Sq-v" offset="0"/><p>0 2</p></lines>
      <extra><technique profile="MAYA"><double_sided>1</double_sided></technique></extra>)";
    const std::string libraries =
        fmt::format(R"(<!-- kept & as it is -->
  <library_animations><animation id="Move"><source id="Move-in"><float_array id="Move-in-a" count="1">0</float_array>
    <technique_common><accessor source="#Move-in-a" count="1"><param name="TIME" type="float"/></accessor></technique_common></source>
    <sampler id="Move-s"><input semantic="INPUT" source="#Move-in"/></sampler>
    <channel source="#Move-s" target="Chair/at"/></animation></library_animations>
  <library_cameras><camera id="Cam"><optics><technique_common><perspective><yfov>40</yfov><znear>0.1</znear><zfar>10</zfar></perspective></technique_common></optics></camera></library_cameras>
  <library_lights><light id="Sun"><technique_common><directional><color>1 1 1</color></directional></technique_common></light></library_lights>
  <library_images><image id="Wood">{}</image></library_images>
  <library_effects>
    <effect id="Floor-fx"><profile_COMMON>{}
        <technique sid="c"><phong>
          <emission><color>0.5 0.25 0 1</color></emission>
          <diffuse><texture texture="smp" texcoord="UV"/></diffuse>
        </phong></technique></profile_COMMON>
      <extra><technique profile="GOOGLEEARTH"><double_sided>1</double_sided></technique></extra></effect>
    <effect id="Red-fx"><profile_COMMON><technique sid="c"><lambert>
          <diffuse><color>0.8 0.1 0.2 1</color></diffuse>
          <transparent opaque="RGB_ZERO"><color>0.5 0.5 0.5 1</color></transparent>
          <transparency><float>0.5</float></transparency>
        </lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials>
    <material id="Floor" name="Floor"><instance_effect url="#Floor-fx"/></material>
    <material id="Red" name="Red"><instance_effect url="#Red-fx"/></material>
  </library_materials>
  <library_geometries>{}</library_geometries>
  <library_controllers><controller id="Skin"><skin source="#Square">
    <source id="Skin-j"><Name_array id="Skin-j-a" count="1">Bone</Name_array>
      <technique_common><accessor source="#Skin-j-a" count="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
    <source id="Skin-w"><float_array id="Skin-w-a" count="1">1</float_array>
      <technique_common><accessor source="#Skin-w-a" count="1"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
    <source id="Skin-b"><float_array id="Skin-b-a" count="16">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</float_array>
      <technique_common><accessor source="#Skin-b-a" count="1" stride="16"><param name="M" type="float4x4"/></accessor></technique_common></source>
    <joints><input semantic="JOINT" source="#Skin-j"/><input semantic="INV_BIND_MATRIX" source="#Skin-b"/></joints>
    <vertex_weights count="4"><input semantic="JOINT" source="#Skin-j" offset="0"/><input semantic="WEIGHT" source="#Skin-w" offset="1"/>
      <vcount>1 1 1 1</vcount><v>0 0 0 0 0 0 0 0</v></vertex_weights></skin></controller></library_controllers>
  <library_nodes><node id="Chair" name="Chair"><translate sid="at">0 0 2</translate>
      <instance_geometry url="#Square">{}</instance_geometry></node></library_nodes>)",
                    image, sampler, squareGeometry(kSquareAsQuad + second),
                    R"(<bind_material><technique_common>
        <instance_material symbol="sym" target="#Floor"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/></instance_material>
        <instance_material symbol="other" target="#Red"/></technique_common></bind_material>)");
    const std::string nodes = R"(
    <node id="Left" name="Left"><translate>-3 0 0</translate><instance_node url="#Chair"/></node>
    <node id="Right" name="Right"><translate>3 0 0</translate><rotate>0 1 0 90</rotate><scale>2 2 2</scale><instance_node url="#Chair"/></node>
    <node id="Alone"><instance_geometry sid="g" url="#Square" name="alone"/></node>
    <node id="Person"><instance_controller url="#Skin"/></node>
    <node id="Eye"><instance_camera url="#Cam"/></node>
    <node id="SunNode"><instance_light url="#Sun"/></node>
    <extra><technique profile="SOMEBODY"><s:data xmlns:s="urn:somebody"><![CDATA[ a < b ]]><s:more/></s:data></technique></extra>)";
    const std::string asset = R"(<unit name="foot" meter="0.5"/><up_axis>Z_UP</up_axis>)";
    std::string text = documentOf(libraries, nodes, asset, version);
    text.insert(text.find("<COLLADA"), "<?keep me?>\n");
    return text;
}

} // namespace patina::test

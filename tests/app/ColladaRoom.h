// A COLLADA document by hand that tests of commands light.
#pragma once

namespace patina::test {

// A floor, a wall and a light that share one quad, Z up and in centimetres, with what Patina does
// not know.
inline constexpr const char* kColladaRoom = R"(<?xml version="1.0" encoding="utf-8"?>
<!-- kept -->
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><contributor><authoring_tool>by hand</authoring_tool></contributor><created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
  <library_cameras><camera id="cam" name="Cam"><optics><technique_common><perspective><xfov>45</xfov><znear>1</znear><zfar>1000</zfar></perspective></technique_common></optics><extra><technique profile="OTHER"><foo>bar</foo></technique></extra></camera></library_cameras>
  <library_effects>
    <effect id="white-fx"><profile_COMMON><technique sid="common"><lambert><diffuse><color>0.8 0.8 0.8 1</color></diffuse></lambert></technique></profile_COMMON></effect>
    <effect id="lamp-fx"><profile_COMMON><technique sid="common"><lambert><emission><color>1 0.9 0.8 1</color></emission><diffuse><color>0.5 0.5 0.5 1</color></diffuse></lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="white"><instance_effect url="#white-fx"/></material><material id="lamp"><instance_effect url="#lamp-fx"/></material></library_materials>
  <library_geometries><geometry id="quad"><mesh>
    <source id="p"><float_array id="pa" count="12">-100 -100 0 100 -100 0 100 100 0 -100 100 0</float_array><technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node name="Floor"><instance_geometry url="#quad"><bind_material><technique_common><instance_material symbol="m" target="#white"/></technique_common></bind_material></instance_geometry></node>
    <node name="Wall"><translate>0 100 100</translate><rotate>1 0 0 90</rotate><instance_geometry url="#quad"><bind_material><technique_common><instance_material symbol="m" target="#white"/></technique_common></bind_material></instance_geometry></node>
    <node name="Lamp"><translate>0 0 180</translate><rotate>1 0 0 180</rotate><scale>0.3 0.3 0.3</scale><instance_geometry url="#quad"><bind_material><technique_common><instance_material symbol="m" target="#lamp"/></technique_common></bind_material></instance_geometry></node>
    <node name="CamNode"><translate>0 -400 100</translate><instance_camera url="#cam"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

} // namespace patina::test

/* What test_scene.c feeds the loaders: a scene with everything in it, and the changes that must be refused or noted. */
#ifndef GNOMON_TESTS_SCENE_CASES_H
#define GNOMON_TESTS_SCENE_CASES_H

/* Of the base scene: a program that loads it writes the buffer under a name of its own, for tests run side by side. */
#ifndef BASE_URI
#define BASE_URI "test%5Fscene.bin"
#endif

static const struct {
    const char *text, *why;
} json_errors[] = {
    {"", "1:1: a value"},
    {"{", "1:2: a key"},
    {"{\n\"a\" 1}", "2:5: ':'"},
    {"[1,]", "1:4: a value"},
    {"[1 2]", "',' or ']'"},
    {"{\"a\":1,}", "a key"},
    {"{\"a\":1 \"b\":2}", "',' or '}'"},
    {"01", "leading zero"},
    {"-", "a digit"},
    {"1.", "a digit"},
    {"1e", "a digit"},
    {"1e999", "too large"},
    {"nul", "a value"},
    {"True", "a value"},
    {"NaN", "a value"},
    {"\"abc", "does not end"},
    {"\"\\", "escape"},
    {"\"\\x\"", "escape"},
    {"\"\\u12g4\"", "hexadecimal"},
    {"\"\\ud800\\u004\"", "hexadecimal"},
    {"\"\x01\"", "control"},
    {"\"\xC0\x80\"", "UTF-8"},
    {"\"\xED\xA0\x80\"", "UTF-8"},
    {"\"\xF4\x90\x80\x80\"", "UTF-8"},
    {"\"\xE2\x82\"", "UTF-8"},
    {"\"\xFF\"", "UTF-8"},
    {"1 2", "after the end"},
    {"\xEF\xBB\xBF{}", "a value"},
    {"+1", "a value"},
};

static const char base_json[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\n"
    "\"extensionsUsed\":[\"KHR_lights_punctual\",\"KHR_materials_unlit\"],\"extensionsRequired\":[\"KHR_lights_"
    "punctual\"],\n"
    "\"scenes\":[{\"nodes\":[0,2,3],\"extras\":{\"gnomon\":{\"fps\":2,\"filter\":\"5x5\",\"srgb\":true,\"max_"
    "distance\":0.1,"
    "\"ratios\":[0.25,1,false]}}}],\n"
    "\"nodes\":[{\"name\":\"outer\",\"translation\":[10,0,0],\"scale\":[2,2,2],\"children\":[1]},\n"
    "{\"name\":\"inner\",\"mesh\":0,\"rotation\":[0,0,0.7071067811865476,0.7071067811865476],\"extras\":{\"gnomon\":{"
    "\"casts\":0}}}"
    ",\n"
    "{\"name\":\"eye\",\"camera\":0,\"translation\":[0,0,50]},\n"
    "{\"name\":\"sun\",\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476],\"extensions\":{\"KHR_lights_"
    "punctual\":{"
    "\"light\":0}},"
    "\"extras\":{\"gnomon\":{\"strength\":0.5,\"near_offset\":3}}}],\n"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1.5707963267948966,\"znear\":0.5,\"zfar\":80}}],"
    "\n"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"name\":\"sol\",\"type\":\"directional\",\"color\":[1,0.5,"
    "0.25],"
    "\"intensity\":6.283185307179586,"
    "\"extras\":{\"gnomon\":{\"strength\":0.9,\"bias_slope\":2}}}]}},\n"
    "\"materials\":[{\"name\":\"paint\",\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,1,"
    "1]},"
    "\"extras\":{\"gnomon\":{\"receives\":false}}}],\n"
    "\"meshes\":[{\"name\":\"quad\",\"primitives\":[{\"mode\":4,\"attributes\":{\"POSITION\":0,\"NORMAL\":2,\"COLOR_"
    "0\":3},"
    "\"indices\":1,\"material\":0}]}],\n"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},\n"
    "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"},\n"
    "{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},\n"
    "{\"bufferView\":3,\"componentType\":5121,\"normalized\":true,\"count\":4,\"type\":\"VEC4\"},\n"
    "{\"bufferView\":4,\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\"},\n"
    "{\"bufferView\":4,\"byteOffset\":12,\"componentType\":5126,\"count\":9,\"type\":\"VEC3\"},\n"
    "{\"bufferView\":4,\"byteOffset\":120,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"},\n"
    "{\"bufferView\":4,\"byteOffset\":168,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\n"
    "\"animations\":[{\"name\":\"swing\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}"
    ","
    "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"rotation\"}},{\"sampler\":2,\"target\":{\"node\":0,\"path\":"
    "\"scale\"}}],\n"
    "\"samplers\":[{\"input\":4,\"output\":5,\"interpolation\":\"CUBICSPLINE\"},{\"input\":4,\"output\":6},{\"input\":"
    "4,\"output\":"
    "7,\"interpolation\":\"STEP\"}]}],\n"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12},\n"
    "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":108,\"byteLength\":16},"
    "{\"buffer\":0,\"byteOffset\":124,\"byteLength\":204}],\n"
    "\"buffers\":[{\"byteLength\":328,\"uri\":\"" BASE_URI "\"}]}\n";

/* The first `find` in the text becomes `put`; then the error, or a note, holds `expected`. */
typedef struct {
    const char *find, *put, *expected;
} change;

/* Every error path that the JSON alone can reach, with its place. */
static const change gltf_errors[] = {
    {"{\"asset\"", "{,\"asset\"", ":1:2: a key"},
    {"\"asset\":{\"version\":\"2.0\"}", "\"x\":0", "asset is missing"},
    {"\"2.0\"", "\"1.0\"", "/asset: version"},
    {"\"2.0\"", "2", "/asset/version: a string"},
    {"d\":[\"KHR_lights_punctual\"]", "d\":[\"KHR_draco\"]",
     "the required extension KHR_draco is not supported: export without compression"},
    {"d\":[\"KHR_lights_punctual\"]", "d\":[\"EXT_meshopt_compression\"]",
     "EXT_meshopt_compression is not supported: export without compression"},
    {"d\":[\"KHR_lights_punctual\"]", "d\":[\"EXT_mesh_gpu_instancing\"]",
     "/extensionsRequired/0: the required extension EXT_mesh_gpu_instancing is not supported"},
    {"d\":[\"KHR_lights_punctual\"]", "d\":[1]", "/extensionsRequired/0: a string"},
    {"\"scene\":0", "\"scene\":1", "/scene: there are only 1"},
    {"\"scene\":0", "\"scene\":0.5", "/scene: an integer"},
    {"\"scene\":0", "\"scene\":1e300", "/scene: an integer"},
    {"\"fps\":2", "\"fps\":0", "/scenes/0/extras/gnomon/fps: fps must"},
    {"\"5x5\"", "null", "/extras/gnomon/filter: a number, boolean"},
    {"[0.25,1,false]", "[[1]]", "ratios/0: a number, boolean"},
    {"\"nodes\":[0,2,3]", "\"nodes\":[0,2,4]", "/scenes/0/nodes/2: there are only 4"},
    {"\"nodes\":[0,2,3]", "\"nodes\":[2,3]", "no triangles"},
    {"\"children\":[1]", "\"children\":[9]", "/nodes/0/children/0: there are only"},
    {"\"children\":[1]", "\"children\":[0]", "cycle"},
    {"\"children\":[1]", "\"children\":[1,1]", "has a parent already"},
    {"\"children\":[1]", "\"children\":{}", "an array is expected"},
    {"\"translation\":[10,0,0]", "\"translation\":[10,0]", "/nodes/0/translation: 3 numbers"},
    {"\"translation\":[10,0,0]", "\"translation\":[10,0,\"\"]", "/nodes/0/translation/2: a number"},
    {"\"translation\":[0,0,50]", "\"translation\":[0,0,1e300]", "camera's transform"},
    {"\"translation\":[0,0,50]", "\"scale\":[1,1,0]", "camera's transform"},
    {"\"name\":\"sun\"", "\"scale\":[0,0,0]", "light's transform has no direction"},
    {"\"translation\":[0,0,50]", "\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,1,0,0,0,1]", "/nodes/2/matrix: the last row"},
    {"\"camera\":0", "\"camera\":1", "/nodes/2/camera: there are only 1"},
    {"\"type\":\"perspective\"", "\"type\":\"fisheye\"", "type 'fisheye'"},
    {"\"perspective\":{", "\"x\":{", "perspective is missing"},
    {"\"yfov\":1.5707963267948966", "\"yfov\":3.2", "yfov 3.2"},
    {"\"type\":\"perspective\"", "\"type\":\"orthographic\"", "orthographic is missing"},
    {"\"type\":\"perspective\",\"perspective\":{\"yfov\":1.5707963267948966",
     "\"type\":\"orthographic\",\"orthographic\":{\"ymag\":0", "ymag 0"},
    {"\"type\":\"perspective\",\"perspective\":{\"yfov\":1.5707963267948966,\"znear\":0.5",
     "\"type\":\"orthographic\",\"orthographic\":{\"ymag\":2,\"znear\":90", "zfar 80"},
    {"\"light\":0", "\"light\":7", "light: there are only 1"},
    {"\"type\":\"directional\"", "\"type\":\"area\"", "light type 'area'"},
    {"\"color\":[1,0.5", "\"color\":[-1,0.5", "must not be negative"},
    {"\"intensity\":6.28", "\"intensity\":-6.28", "must not be negative"},
    {"\"intensity\":6.283185307179586", "\"intensity\":1e300", "too large"},
    {"\"strength\":0.5", "\"strength\":1.5", "/nodes/3/extras/gnomon/strength: 1.5 is not in"},
    {"\"strength\":0.5", "\"strenght\":0.5", "/nodes/3/extras/gnomon/strenght: unknown knob"},
    {"\"strength\":0.9", "\"casts\":1", "lights/0/extras/gnomon/casts: unknown knob"},
    {"\"casts\":0", "\"shadow\":0", "/nodes/1/extras/gnomon/shadow: unknown knob"},
    {"\"casts\":0", "\"casts\":2", "true or false"},
    {"\"receives\":false", "\"shadow\":false", "/materials/0/extras/gnomon/shadow: unknown"},
    {"\"name\":\"eye\"", "\"extras\":{\"gnomon\":{\"fov\":1}}", "neither a mesh nor a light"},
    {"{\"gnomon\":{\"casts\":0}}", "{\"gnomon\":1}", "/nodes/1/extras/gnomon: an object"},
    {"\"baseColorFactor\":[0.5,", "\"baseColorFactor\":[", "4 numbers"},
    {"\"baseColorFactor\":", "\"baseColorTexture\":{},\"baseColorFactor\":", "/baseColorTexture: index is missing"},
    {"\"baseColorFactor\":", "\"baseColorTexture\":{\"index\":0},\"baseColorFactor\":", "index: there are only 0"},
    {"\"doubleSided\":true", "\"alphaMode\":\"GLASS\"", "/materials/0: alphaMode 'GLASS'"},
    {"\"receives\":false", "\"caster\":\"never\"",
     "/materials/0/extras/gnomon/caster: 'never' is not off, on, clip or dither"},
    {"\"receives\":false", "\"visible_alpha\":\"on\"", "visible_alpha: 'on' is not opaque, clip, dither or blend"},
    {"\"receives\":false", "\"alpha_cutoff\":2", "alpha_cutoff: 2 is not in 0..1"},
    {"\"receives\":false", "\"emissive\":256", "emissive: 256 is not in 0..255"},
    {"\"receives\":false", "\"specular\":-1", "specular: -1 is not in 0..1"},
    {"\"receives\":false", "\"specular\":[0,1]", "specular: 3 numbers"},
    {"\"receives\":false", "\"specular\":[0,1,2]", "specular: 2 is not in 0..1"},
    {"\"receives\":false", "\"shininess_log2\":8", "shininess_log2: an integer in 0..7"},
    {"\"receives\":false", "\"mask_texture\":0", "mask_texture: there are only 0"},
    {"\"receives\":false", "\"hidden\":2", "hidden: true or false"},
    {"\"mesh\":0", "\"mesh\":1", "/nodes/1/mesh: there are only 1"},
    {"\"primitives\":[", "\"x\":[", "/meshes/0: primitives are missing"},
    {"\"mode\":4", "\"mode\":7", "mode 7"},
    {"\"primitives\":[{", "\"primitives\":[1,{", "/meshes/0/primitives/0: an object"},
    {"\"attributes\":{", "\"x\":{", "attributes is missing"},
    {"\"POSITION\":0", "\"POSITION\":3", "POSITION: VEC3"},
    {"\"POSITION\":0", "\"POSITION\":99", "POSITION: there are only"},
    {"\"NORMAL\":2", "\"NORMAL\":3", "NORMAL: VEC3"},
    {"\"NORMAL\":2", "\"NORMAL\":7", "NORMAL: 3 elements, but"},
    {"\"COLOR_0\":3", "\"COLOR_0\":1", "COLOR_0: 6 elements"},
    {"\"indices\":1", "\"indices\":2", "indices: SCALAR"},
    {"\"material\":0", "\"material\":1", "material: there are only"},
    {"\"count\":4", "\"count\":3", "NORMAL: 4 elements, but POSITION has 3"},
    {"\"count\":4", "\"count\":0", "no triangles"},
    {"\"count\":4", "\"count\":5", "5 elements reach beyond"},
    {"\"count\":4", "\"count\":2000000000", "reach beyond"},
    {"\"count\":4", "\"count\":1e19", "an integer"},
    {"\"bufferView\":0,\"componentType\":5126,\"count\":4", "\"componentType\":5126,\"count\":2000000000",
     "without a bufferView"},
    {"\"componentType\":5126", "\"componentType\":5124", "componentType 5124"},
    {"\"componentType\":5126", "\"componentType\":5125", "VEC3 of float"},
    {"\"componentType\":5126", "\"normalized\":true,\"componentType\":5126", "cannot be normalized"},
    {"\"VEC3\"", "\"MAT3\"", "type 'MAT3'"},
    {"\"bufferView\":0", "\"bufferView\":5", "bufferView: there are only 5"},
    {"\"bufferView\":0", "\"byteOffset\":4,\"bufferView\":0", "reach beyond"},
    {"\"bufferView\":0", "\"byteOffset\":2147483647,\"bufferView\":0", "reach beyond"},
    {"{\"buffer\":0,", "{", "/bufferViews/0: buffer is missing"},
    {"\"byteLength\":48}", "\"x\":48}", "byteLength is missing"},
    {"\"byteLength\":48}", "\"byteLength\":480}", "outside buffer 0"},
    {"\"byteLength\":48}", "\"byteLength\":48,\"byteStride\":3}", "byteStride 3"},
    {"\"byteLength\":48}", "\"byteLength\":48,\"byteStride\":8}", "longer than byteStride"},
    {"\"byteLength\":48}", "\"byteLength\":48,\"byteOffset\":2147483647}", "outside buffer"},
    {"\"byteLength\":328,", "", "byteLength is missing"},
    {BASE_URI, "no_such_file.bin", "/buffers/0/uri: build/tmp/no_such_file.bin cannot be opened"},
    {BASE_URI, "http://a/b", "only files"},
    {BASE_URI, "data:x", "no comma"},
    {BASE_URI, "file:///a/b", "file:///a/b: only files"},
    {BASE_URI, "/a/b", "/buffers/0/uri: /a/b is outside the folder"},
    {BASE_URI, "C:/a/b", "C:/a/b is outside the folder"},
    {BASE_URI, "data:,abc", "outside buffer 0 of 3 bytes"},
    {BASE_URI, "data:;base64,abc", "outside buffer 0 of 2 bytes"},
    {BASE_URI, "data:;base64,abcda", "cut off at 5"},
    {BASE_URI, "data:;base64,ab=c", "bad character at 3"},
    {BASE_URI, "data:;base64,ab*d", "bad character at 2"},
    {BASE_URI, "data:;base64,a=bc", "bad character at 1"},
    {BASE_URI, "data:;base64,=abc", "bad character at 0"},
    {",\"uri\":\"" BASE_URI "\"", "", "/buffers/0: it has no data"},
    {"\"accessors\":[", "\"accessors\":[1,", "/accessors/0: an object"},
    {"\"nodes\":[{", "\"nodes\":{},\"x\":[{", "/nodes: an array"},
    {"\"sampler\":0,", "\"sampler\":3,", "sampler: there are only 3"},
    {"\"sampler\":0,", "", "sampler and target are"},
    {"\"path\":\"scale\"", "\"path\":\"colour\"", "path 'colour'"},
    {"\"node\":0,", "\"node\":4,", "node: there are only"},
    {"\"interpolation\":\"STEP\"", "\"interpolation\":\"BEZIER\"", "'BEZIER'"},
    {"\"input\":4,\"output\":5", "\"input\":4", "input and output"},
    {"\"input\":4", "\"input\":0", "times must be"},
    {"\"output\":6", "\"output\":7", "4 components"},
    {"\"output\":5", "\"output\":7", "9 values are expected"},
    {"\"channels\":[", "\"channels\":[0,", "/animations/0/channels/0: an object"},
    {"\"mesh\":0", "\"mesh\":0,\"skin\":0", "there are only 0 of these"},
};

/* What is accepted, with a note. */
static const change gltf_notes[] = {
    {"\"scene\":0", "\"scene\":-1", "null or a reference below 0 counts as not there: 1 of them, the first is /scene"},
    {"\"byteLength\":328", "\"byteLength\":329", "buffer 0: 329 bytes are announced, 328 are there"},
    {"\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476]", "\"rotation\":[0,0,0,0]",
     "a rotation of a node is zero"},
    {"\"bufferView\":4,\"byteOffset\":120,", "", "a rotation of an animation is zero"},
    {"{\"bufferView\":4,\"componentType\"", "{\"componentType\"", "keys of animations come twice for one time"},
    {"\"translation\":[10,0,0],\"scale\":[2,2,2]", "\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]",
     "animation of node 0 ignored: the node has a matrix"},
    {"\"type\":\"perspective\",\"perspective\":{\"yfov\":1.5707963267948966,\"znear\":0.5",
     "\"type\":\"orthographic\",\"orthographic\":{\"ymag\":2,\"znear\":-1", "the camera is moved back by 1.002"},
    {"\"type\":\"perspective\",\"perspective\":{\"yfov\":1.5707963267948966",
     "\"type\":\"orthographic\",\"orthographic\":{\"ymag\":-2", "ymag -2 of the camera is negative: 2 is taken"},
    {"\"yfov\":1.5707963267948966", "\"yfov\":0.001",
     "the camera sees 0.0573 degrees from top to bottom: drawn are 0.448"},
    {"\"yfov\":1.5707963267948966", "\"yfov\":3.14", "the camera sees 180 degrees from top to bottom: drawn are 176"},
    {"\"znear\":0.5", "\"znear\":0", "znear 0 of the camera is not positive"},
    {"\"zfar\":80", "\"zfar\":0.5", "zfar 0.5 of the camera is not beyond its znear"},
    {"\"normalized\":true,", "", "vertex colours of 'quad' are integers that are not normalized: taken for 255ths"},
    {"\"KHR_materials_unlit\"]", "\"EXT_fog\"]", "extension EXT_fog ignored"},
    {"d\":[\"KHR_lights_punctual\"]", "d\":[\"KHR_texture_basisu\"]",
     "extension KHR_texture_basisu ignored: it is not supported, export textures as PNG"},
    {"\"path\":\"scale\"", "\"path\":\"pointer\"", "KHR_animation_pointer ignored"},
    {"\"mode\":4", "\"mode\":4,\"targets\":[]", "morph targets"},
    {"\"pbrMetallicRoughness\":{", "\"pbrMetallicRoughness\":{\"metallicRoughnessTexture\":{},",
     "metallic-roughness texture of material 'paint' ignored: only base colour"},
    {"\"doubleSided\":true", "\"alphaMode\":\"MASK\",\"alphaCutoff\":1.5",
     "alpha cutoff of material 'paint' is above 1"},
    {"\"doubleSided\":true", "\"emissiveFactor\":[2,0,0]", "emissive colour of material 'paint' outside 0..1"},
    {"[0.5,0.25,1,1]", "[0.5,0.25,2,1]", "outside 0..1"},
    {"\"strength\":0.9", "\"near\":1", "near of directional light 'sol'"},
    {"\"name\":\"sun\"", "\"camera\":0", "the first camera"},
    {"\"path\":\"scale\"", "\"path\":\"weights\"", "morph weights"},
    {"\"path\":\"scale\"", "\"path\":\"translation\"", "moves the same property"},
    {"\"name\":\"paint\"", "\"name\":\"a\\nb\",\"normalTexture\":{}", "material 'a?b'"},
    {"\"count\":6", "\"count\":5", "last 2 corners"},
    {"\"scenes\":[", "\"scenes\":[{\"nodes\":[0,2,3]},", "scene 0 of 2"},
    {"\"primitives\":[", "\"primitives\":[{\"mode\":1,\"attributes\":{}},", "points and lines of mesh 'quad'"},
    {"\"primitives\":[", "\"primitives\":[{\"attributes\":{}},", "no POSITION"},
};

static const struct {
    const char *text, *why;
} obj_errors[] = {
    {"", "no faces"},
    {"v 0 0 0\n", "no faces"},
    {"v 0 0\n", ":1: v takes 3"},
    {"\nv 1 2 x\n", ":2: 'x' is not a number"},
    {"v 1 2 nan\n", "no faces"},
    {"v 0 0 0\nv 1 0 0\nv 1 2 1e999\nf 1 2 3\n", ":4: all faces name vertices that are out of range or have no place"},
    {"v 0 0 0\nv 1 0 0\nv 1 2 nano\nf 1 2 4\n", ":4: all faces name vertices that are out of range or have no place"},
    {"v 1 2 0x3\n", "is not a number"},
    {"v 1 2 1.2.3\n", "is not a number"},
    {"v 0 0 0\nf 1 1\n", "no faces"},
    {"f 1 2 3\n", ":1: all faces name vertices that are out of range"},
    {"v 0 0 0\nf 1 1 x\n", "index of a vertex is missing"},
    {"v 0 0 0\nf 1 1 1///\n", "index of a normal"},
    {"v 0 0 0\nvt 0 0\nvn 1 0 0\nf 1 1 1/1/1/1\n", "not a corner"},
    {"v 0 0 0\nvn 1 0 0\nf 1 1 1//1/1\n", "not a corner"},
    {"v 0 0 0\nf 1 1 1x\n", "not a corner"},
    {"v 0 0 0\nf 1 1 +\n", "'+' is not a corner"},
    {"v 0 0 0\nf 1 1 1/x\n", "index of a texture coordinate is missing"},
};

static const struct {
    const char *text, *why;
    double red; /* of material a */
} mtl_errors[] = {
    {"Kd 1 1 1\nd 0.5\n", "line 1: Kd before any newmtl", 0.8},
    {"newmtl\nKd 1 0 0\nnewmtl a\nKd 0.5 0 0\n", "line 1: newmtl without a name", 0.5},
    {"newmtl a\nKd 0.5 0 0\nnewmtl # b\nKd 1 0 0\n", "line 3: newmtl without a name", 0.5},
    {"newmtl a\nKd 0.5 0 0\nKd 1 2\n", "line 3: Kd takes 3", 0.5},
    {"newmtl a\nKd 1 2 red\nKd 0.25 0 0\n", "'red' is not", 0.25},
    {"newmtl a\nd\n", "d takes a number", 0.8},
    {"newmtl a\nTr 1 2\n", "more than 1", 0.8},
    {"newmtl a\nmap_Kd\n", "map_Kd without", 0.8},
    {"map_Kd a.png\n", "map_Kd before any newmtl", 0.8},
    {"newmtl a\nmap_Kd -s 1 1 1 -clamp on\n", "map_Kd without", 0.8},
};

#endif

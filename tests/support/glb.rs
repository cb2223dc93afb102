//! Small glTF files, made in code.

/// A glTF file in the making: lists of JSON objects, and the binary chunk.
#[derive(Clone, Debug, Default)]
pub struct Glb {
    /// The binary chunk.
    pub buffer: Vec<u8>,
    /// `bufferViews`.
    pub views: Vec<String>,
    /// `accessors`.
    pub accessors: Vec<String>,
    /// `images`.
    pub images: Vec<String>,
    /// `textures`.
    pub textures: Vec<String>,
    /// `materials`.
    pub materials: Vec<String>,
    /// `meshes`.
    pub meshes: Vec<String>,
    /// `nodes`, all of them roots of the scene.
    pub nodes: Vec<String>,
    /// `lights` of `KHR_lights_punctual`.
    pub lights: Vec<String>,
}

impl Glb {
    /// A floor of 2 m and a wall behind it, white, with a lamp of 100 cd above: what lights up when it is baked.
    pub fn room() -> Self {
        let mut glb = Self::default();
        glb.materials.push(
            r#"{"name":"white","pbrMetallicRoughness":{"baseColorFactor":[0.8,0.8,0.8,1],"metallicFactor":0}}"#.into(),
        );
        glb.quad("Floor", [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]]);
        glb.quad("Wall", [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [1.0, 2.0, -1.0], [-1.0, 2.0, -1.0]]);
        glb.point_light([0.2, 1.5, 0.3], 100.0);
        glb
    }

    /// Appends bytes and returns the index of their view.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let (offset, length) = (self.buffer.len(), bytes.len());
        self.views.push(format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{length}}}"#));
        self.buffer.extend(bytes);
        self.views.len() - 1
    }

    /// Appends positions and returns the index of their accessor.
    pub fn positions(&mut self, positions: &[[f32; 3]]) -> usize {
        let bytes: Vec<u8> = positions.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        let (view, count) = (self.view(&bytes), positions.len());
        // Readers want bounds; nobody checks that they are tight.
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":5126,"type":"VEC3","count":{count},"min":[-9,-9,-9],"max":[9,9,9]}}"#
        ));
        self.accessors.len() - 1
    }

    /// Appends indices and returns the index of their accessor.
    pub fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let (view, count) = (self.view(&bytes), indices.len());
        self.accessors.push(format!(r#"{{"bufferView":{view},"componentType":5123,"type":"SCALAR","count":{count}}}"#));
        self.accessors.len() - 1
    }

    /// Appends a node with a quadrilateral of two triangles in the first material.
    pub fn quad(&mut self, name: &str, corners: [[f32; 3]; 4]) {
        let (positions, indices) = (self.positions(&corners), self.indices(&[0, 1, 2, 0, 2, 3]));
        self.meshes.push(format!(
            r#"{{"primitives":[{{"attributes":{{"POSITION":{positions}}},"indices":{indices},"material":0}}]}}"#
        ));
        self.nodes.push(format!(r#"{{"name":"{name}","mesh":{}}}"#, self.meshes.len() - 1));
    }

    /// Appends a point light.
    pub fn point_light(&mut self, position: [f32; 3], candela: f32) {
        self.lights.push(format!(r#"{{"type":"point","intensity":{candela}}}"#));
        let light = self.lights.len() - 1;
        self.nodes.push(format!(
            r#"{{"name":"Lamp","translation":{position:?},"extensions":{{"KHR_lights_punctual":{{"light":{light}}}}}}}"#
        ));
    }

    /// The JSON, with something more at its top level, such as `"extensionsRequired":["X"]`.
    pub fn json(&self, more: &str) -> String {
        let mut parts = vec![r#""asset":{"version":"2.0"}"#.to_owned(), r#""scene":0"#.to_owned()];
        let roots: Vec<String> = (0..self.nodes.len()).map(|node| node.to_string()).collect();
        parts.push(format!(r#""scenes":[{{"nodes":[{}]}}]"#, roots.join(",")));
        if !self.buffer.is_empty() {
            parts.push(format!(r#""buffers":[{{"byteLength":{}}}]"#, self.buffer.len()));
        }
        for (key, list) in [
            ("bufferViews", &self.views),
            ("accessors", &self.accessors),
            ("images", &self.images),
            ("textures", &self.textures),
            ("materials", &self.materials),
            ("meshes", &self.meshes),
            ("nodes", &self.nodes),
        ] {
            if !list.is_empty() {
                parts.push(format!(r#""{key}":[{}]"#, list.join(",")));
            }
        }
        if !self.lights.is_empty() {
            parts.push(r#""extensionsUsed":["KHR_lights_punctual"]"#.into());
            let lights = self.lights.join(",");
            parts.push(format!(r#""extensions":{{"KHR_lights_punctual":{{"lights":[{lights}]}}}}"#));
        }
        if !more.is_empty() {
            parts.push(more.to_owned());
        }
        format!("{{{}}}", parts.join(","))
    }

    /// The whole file.
    pub fn bytes(&self) -> Vec<u8> {
        let mut json = self.json("").into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut binary = self.buffer.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let binary_chunk = if binary.is_empty() { 0 } else { binary.len() + 8 };
        let mut file = b"glTF".to_vec();
        let words = [2, (20 + json.len() + binary_chunk) as u32, json.len() as u32, 0x4E4F_534A];
        file.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        file.extend(json);
        if binary_chunk > 0 {
            file.extend((binary.len() as u32).to_le_bytes());
            file.extend(b"BIN\0");
            file.extend(binary);
        }
        file
    }
}

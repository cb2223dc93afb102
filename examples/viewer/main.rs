//! Bakes a glTF scene, or the Cornell box, in the background and shows its light and how its lightmaps are cut.

mod args;
mod bar;
mod camera;
mod false_color;
mod scene;
mod screenshot;
mod truth;
mod views;
mod windowless;

use bevy::app::PluginGroupBuilder;
use bevy::prelude::*;
use bevy_radiosity::prelude::*;

use crate::args::Args;

fn main() -> AppExit {
    let args = match Args::read(std::env::args().skip(1)) {
        Ok(args) => args,
        Err(message) => {
            eprintln!("{message}\n\n{}", args::HELP);
            return AppExit::from_code(2);
        }
    };
    let mut app = App::new();
    let defaults = DefaultPlugins.set(AssetPlugin { file_path: args.folder(), ..default() });
    if args.screenshot.is_some() {
        app.add_plugins((windowless::without_window(defaults), screenshot::plugin));
    } else {
        app.add_plugins((in_window(defaults), bar::plugin));
    }
    app.add_plugins((RadiosityPlugins, camera::plugin, scene::plugin, views::plugin, truth::plugin))
        .insert_resource(args.bake_settings())
        .insert_resource(args.view)
        .insert_resource(args)
        .run()
}

fn in_window(defaults: PluginGroupBuilder) -> PluginGroupBuilder {
    println!("{}", args::HELP);
    defaults.set(WindowPlugin { primary_window: Some(Window { title: "viewer".into(), ..default() }), ..default() })
}

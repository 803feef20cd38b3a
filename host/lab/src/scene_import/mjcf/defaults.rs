//! Defaults of MJCF: classes of attributes, each in another, which elements take where they state none.

use std::collections::HashMap;

use super::orientation::FORMS;
use crate::scene_import::element::Element;
use crate::scene_import::{Found, shown};

/// Most classes; each keeps the attributes of those around it.
const MOST_CLASSES: usize = 5_000;
/// The elements that take defaults here.
const KINDS: [&str; 3] = ["geom", "mesh", "joint"];
/// The class of all that name none.
pub const MAIN: &str = "main";

/// The classes by their names.
#[derive(Debug, Default)]
pub struct Defaults {
    classes: HashMap<String, HashMap<&'static str, Element>>,
}

impl Defaults {
    /// The classes of a model.
    pub fn new(model: &Element) -> Found<Self> {
        let mut defaults = Self::default();
        defaults.classes.insert(MAIN.to_owned(), HashMap::new());
        for top in model.named("default") {
            defaults.class(top, top.attribute("class").unwrap_or(MAIN), MAIN)?;
        }
        Ok(defaults)
    }

    /// An element with what it takes from its class, or else from the one of the bodies around it.
    pub fn of(&self, element: &Element, around: &str) -> Found<Element> {
        let class = element.attribute("class").unwrap_or(around);
        let class = self.classes.get(class);
        let class = class.ok_or_else(|| {
            element.fault(&format!("the class {} is not there", shown(element.attribute("class").unwrap_or(around))))
        })?;
        let Some(defaults) = class.get(element.name.as_str()) else { return Ok(element.clone()) };
        let mut whole = element.clone();
        take(&mut whole, defaults);
        Ok(whole)
    }

    fn class(&mut self, element: &Element, name: &str, parent: &str) -> Found<()> {
        let mut kinds = self.classes.get(parent).cloned().unwrap_or_default();
        for kind in KINDS {
            for stated in element.named(kind) {
                let mut stated = stated.clone();
                if let Some(around) = kinds.get(kind) {
                    take(&mut stated, around);
                }
                kinds.insert(kind, stated);
            }
        }
        if self.classes.len() > MOST_CLASSES {
            return Err(element.fault(&format!("more than {MOST_CLASSES} classes of defaults")));
        }
        self.classes.insert(name.to_owned(), kinds);
        for inner in element.named("default") {
            self.class(inner, inner.required("class")?, name)?;
        }
        Ok(())
    }
}

/// Takes the attributes that it does not state itself; of the forms of an orientation, none if it states one.
fn take(element: &mut Element, from: &Element) {
    let turned = FORMS.iter().any(|form| element.attribute(form).is_some());
    for (name, value) in from.attributes() {
        if name != "class" && element.attribute(name).is_none() && !(turned && FORMS.contains(&name.as_str())) {
            element.set(name, value);
        }
    }
}

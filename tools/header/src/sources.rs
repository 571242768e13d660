//! The files of `src/ffi`, with every `record!` written out, since cbindgen does not look into macros, and every enumeration of
//! the core that C has under another name.

use std::error::Error;
use std::fs;
use std::path::Path;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, Ident, Item, ItemEnum, Token, Type, UseTree, Visibility, parse_quote};

/// The files in the order of the header.
const ORDER: &[&str] = &[
    "status.rs",
    "progress.rs",
    "mesh.rs",
    "mesh_parts.rs",
    "mesh_fields.rs",
    "mesh_cut.rs",
    "mesh_file.rs",
    "decimate.rs",
    "parameterize.rs",
    "sphere.rs",
    "features.rs",
    "layout.rs",
    "report.rs",
    "surface.rs",
    "surface_eval.rs",
    "trims.rs",
    "patch.rs",
    "demands.rs",
    "choices.rs",
    "tensor.rs",
    "tensor_parts.rs",
    "field.rs",
    "from_patches.rs",
    "transfer.rs",
    "query.rs",
    "mesh_query.rs",
    "rows.rs",
    "extent.rs",
    "fair.rs",
    "label.rs",
    "export.rs",
    "step.rs",
    "report_page.rs",
    "model.rs",
    "model_parts.rs",
    "model_measure.rs",
    "model_file.rs",
    "model_fit.rs",
    "model_query.rs",
    "curve.rs",
    "curve_query.rs",
    "tspline.rs",
    "pht.rs",
    "pht_edit.rs",
    "pht_parts.rs",
    "d1rc.rs",
    "d1rc_fit.rs",
];

/// A file and what it declares.
pub struct Source {
    pub name: &'static str,
    pub file: syn::File,
}

/// `record! { pub struct planish_x_options (planish_x_options_init; core: XOptions) { pub field: type = default, } }`
struct Record {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    init: Option<Ident>,
    fields: Punctuated<Field, Token![,]>,
}

struct Field {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    of: Type,
}

impl Parse for Record {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        input.parse::<Token![struct]>()?;
        let name = input.parse()?;
        let mut init = None;
        if input.peek(syn::token::Paren) {
            let inner;
            syn::parenthesized!(inner in input);
            init = Some(inner.parse()?);
            inner.parse::<proc_macro2::TokenStream>()?; // where defaults come from is Rust's business
        }
        let inner;
        syn::braced!(inner in input);
        let fields = inner.parse_terminated(Field::parse, Token![,])?;
        Ok(Self { attributes, visibility, name, init, fields })
    }
}

impl Parse for Field {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        let name = input.parse()?;
        input.parse::<Token![:]>()?;
        let of = input.parse()?;
        if input.parse::<Option<Token![=]>>()?.is_some() {
            input.parse::<Expr>()?;
        }
        Ok(Self { attributes, visibility, name, of })
    }
}

impl Record {
    /// What the macro declares for C: the record, its size first, and the function that fills it.
    fn items(&self) -> Vec<Item> {
        let Self { attributes, visibility, name, .. } = self;
        let told = match &self.init {
            Some(init) => format!(" Set by {init}()."),
            None => format!(" sizeof({name}) as the caller sees it."),
        };
        let fields = self.fields.iter().map(|field| {
            let Field { attributes, visibility, name, of } = field;
            quote::quote!(#(#attributes)* #visibility #name: #of)
        });
        let mut items = vec![parse_quote! {
            #(#attributes)*
            #[repr(C)]
            #visibility struct #name {
                #[doc = #told]
                pub struct_size: usize,
                #(#fields,)*
            }
        }];
        if let Some(init) = &self.init {
            let size = format!(" struct_size: sizeof({name}).");
            items.push(parse_quote! {
                /// Fills options with the defaults.
                ///
                /// options:     struct_size writable bytes.
                #[doc = #size]
                /// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
                #[unsafe(no_mangle)]
                pub unsafe extern "C" fn #init(options: *mut #name, struct_size: usize) -> planish_status {}
            });
        }
        items
    }
}

/// The items of a file with those of its records, and with enumerations of the core below `source`.
fn written_out(items: Vec<Item>, source: &Path) -> Result<Vec<Item>, Box<dyn Error>> {
    let mut all = Vec::new();
    for item in items {
        match &item {
            Item::Macro(call) if is_record(call) => {
                all.extend(call.mac.parse_body::<Record>()?.items());
            }
            Item::Use(used) if matches!(used.vis, Visibility::Public(_)) => {
                all.push(Item::Enum(core_enumeration(&used.tree, source)?));
            }
            _ => all.push(item),
        }
    }
    Ok(all)
}

/// `pub use crate::module::Name as planish_name;`: the enumeration of the core, under its name in C.
fn core_enumeration(tree: &UseTree, source: &Path) -> Result<ItemEnum, Box<dyn Error>> {
    let mut modules = Vec::new();
    let mut rest = tree;
    while let UseTree::Path(path) = rest {
        modules.push(path.ident.to_string());
        rest = &path.tree;
    }
    let UseTree::Rename(named) = rest else {
        return Err("a public use has to name an enumeration anew".into());
    };
    let place = source.join(modules[1..].join("/"));
    let file = [place.with_extension("rs"), place.join("mod.rs")].into_iter().find(|file| file.exists());
    let file =
        syn::parse_file(&fs::read_to_string(file.ok_or(format!("{} is no module", place.display()))?)?)?;
    let mut enumerations = file.items.into_iter().filter_map(|item| match item {
        Item::Enum(item) if item.ident == named.ident => Some(item),
        _ => None,
    });
    let found = enumerations.next().ok_or(format!("there is no enumeration {}", named.ident))?;
    Ok(ItemEnum { ident: named.rename.clone(), ..found })
}

fn is_record(call: &syn::ItemMacro) -> bool {
    call.mac.path.is_ident("record") && matches!(call.mac.delimiter, syn::MacroDelimiter::Brace(_))
}

/// All files that have a part in the header. One that `mod.rs` publishes but ORDER does not know is an error.
pub fn read(folder: &Path) -> Result<Vec<Source>, Box<dyn Error>> {
    let published = fs::read_to_string(folder.join("mod.rs"))?;
    let published = published.lines().filter_map(|line| line.strip_prefix("pub use ")?.strip_suffix("::*;"));
    for module in published {
        if !ORDER.iter().any(|name| name.strip_suffix(".rs") == Some(module)) {
            return Err(format!("tools/header/src/sources.rs: ORDER lacks \"{module}.rs\"").into());
        }
    }
    let parsed = ORDER.iter().map(|&name| -> Result<Source, Box<dyn Error>> {
        let told = |error: &dyn std::fmt::Display| format!("src/ffi/{name}: {error}");
        let text = fs::read_to_string(folder.join(name))?;
        let mut file = syn::parse_file(&text).map_err(|error| told(&error))?;
        file.items = written_out(file.items, &folder.join("..")).map_err(|error| told(&error))?;
        Ok(Source { name, file })
    });
    parsed.collect()
}

const form = document.querySelector("form");
const field = document.querySelector("#token");
const message = document.querySelector("[role=alert]");

async function signIn(token) {
  const response = await fetch("/api/v1/session", {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ token }),
  });
  if (response.ok) location.replace(`/${location.search}`) // the page, with the voice of a shared link;
  else message.textContent = (await response.json()).detail;
}

form.addEventListener("submit", (event) => {
  event.preventDefault();
  signIn(field.value.trim());
});

// The link in the terminal carries the token after the #, which browsers keep to themselves.
if (location.hash.length > 1) {
  const token = decodeURIComponent(location.hash.slice(1));
  history.replaceState(null, "", location.pathname + location.search);
  signIn(token);
}
